// The light that fell on the face: its map and its main lights.

import type { DoneEstimate } from '../api/types.ts';
import type { Chosen, Subject } from '../state/workbench.ts';
import { degrees, metres } from './format.ts';
import { LightsTable } from './LightsTable.tsx';
import { Panorama } from './Panorama.tsx';
import { Choice } from './parts/Choice.tsx';

interface Props {
  estimate: DoneEstimate;
  subject: Subject;
  onChoose(chosen: Chosen): void;
}

export function LightPanel({ estimate, subject, onChoose }: Props) {
  const { faces, joint_folder: joint, report } = estimate;
  const options = faces.map((_, index) => ({ value: String(index), text: `Face ${index + 1}` }));
  if (joint !== null) options.push({ value: 'joint', text: 'All faces together' });
  return (
    <section class="card" aria-labelledby="light-title">
      <h2 id="light-title">Light</h2>
      {faces.length > 1 && (
        <Choice
          label="Seen by"
          options={options}
          value={String(subject.chosen)}
          onChange={(value) => onChoose(value === 'joint' ? 'joint' : Number(value))}
        />
      )}
      <Panorama estimate={estimate} subject={subject} />
      <LightsTable lights={subject.light.main_lights} />
      <ul class="notes fine">
        {noteOf(estimate, subject)}
        {report.camera.focal_source.startsWith('default') && (
          <li>The photo does not tell its focal length; a 50 mm lens is assumed, so distances are rough.</li>
        )}
        {report.warnings.map((warning) => (
          <li key={warning}>{warning}</li>
        ))}
      </ul>
    </section>
  );
}

function noteOf({ report }: DoneEstimate, { chosen }: Subject) {
  if (chosen === 'joint') return <li>One light for all faces, as if all stood in one place.</li>;
  const face = report.faces[chosen]!;
  return (
    <li>
      The face is {metres(Math.hypot(...face.position_m))} from the camera, turned {degrees(Math.abs(face.yaw_deg))}{' '}
      from it.
    </li>
  );
}
