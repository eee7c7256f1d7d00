// The faces that were found. Several can be chosen from; one is only shown.

import type { DoneEstimate } from '../api/types.ts';
import { boxOf } from '../light/box.ts';
import type { Chosen, Subject } from '../state/workbench.ts';
import { placed } from './format.ts';

interface Props {
  estimate: DoneEstimate;
  subject: Subject;
  onChoose(chosen: Chosen): void;
}

export function FaceBoxes({ estimate, subject, onChoose }: Props) {
  const { faces, photo } = estimate;
  if (faces.length === 1) return <div class="face-box" style={placed(boxOf(faces[0]!.box_px, photo))} />;
  return (
    <div role="group" aria-label="Faces in the photo">
      {faces.map((face, index) => (
        <button
          key={index}
          type="button"
          class="face-box"
          style={placed(boxOf(face.box_px, photo))}
          aria-pressed={subject.chosen === index}
          aria-label={`Face ${index + 1} of ${faces.length}`}
          onClick={() => onChoose(index)}
        >
          <span aria-hidden="true">{index + 1}</span>
        </button>
      ))}
    </div>
  );
}
