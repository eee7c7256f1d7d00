// The photo, and over it whatever is switched on: the faces, their meshes, the thing that is put in.

import { addressOf } from '../api/client.ts';
import type { DoneEstimate, Info, Insertion } from '../api/types.ts';
import { hasWebGl } from '../stage/webgl.ts';
import type { PlacedObject } from '../state/object.ts';
import type { Chosen, Shown, Subject } from '../state/workbench.ts';
import { FaceBoxes } from './FaceBoxes.tsx';
import { GhostBox } from './GhostBox.tsx';
import { MeshLines } from './MeshLines.tsx';
import { Check } from './parts/Check.tsx';
import { Choice } from './parts/Choice.tsx';
import { StageCanvas } from './StageCanvas.tsx';

export type PictureKind = 'preview' | 'rendered';

interface Props {
  estimate: DoneEstimate;
  info: Info | undefined;
  subject: Subject;
  onChoose(chosen: Chosen): void;
  object: PlacedObject;
  rendered: Insertion | undefined;
  kind: PictureKind;
  onKind(kind: PictureKind): void;
  shown: Shown;
  onShown(part: Partial<Shown>): void;
  onStageTrouble(sentence: string | undefined): void;
}

const kinds = [
  { value: 'preview', text: 'Preview' },
  { value: 'rendered', text: 'Rendered' },
] as const;

export function Picture(props: Props) {
  const { estimate, object, rendered, kind, shown, onShown } = props;
  const { width_px: width, height_px: height } = estimate.photo;
  return (
    <section class="picture" aria-label="Picture">
      <div class="frame" style={{ '--aspect': String(width / height) }}>
        <img class="fill" src={addressOf.photo(estimate.id)} alt={`The photo: ${estimate.name}`} />
        {shown.object &&
          (hasWebGl() ? (
            <StageCanvas
              estimate={estimate}
              info={props.info}
              subject={props.subject}
              object={object}
              onTrouble={props.onStageTrouble}
            />
          ) : (
            <GhostBox estimate={estimate} object={object} />
          ))}
        {kind === 'rendered' && rendered && (
          <img
            class="fill"
            src={addressOf.insertionFile(rendered.id, 'composite.png')}
            alt="The photo with the object, rendered"
          />
        )}
        {shown.mesh && <MeshLines estimate={estimate} />}
        {shown.faces && <FaceBoxes estimate={estimate} subject={props.subject} onChoose={props.onChoose} />}
      </div>
      <div class="picture-bar inline-legends">
        {rendered && <Choice label="Picture" options={kinds} value={kind} onChange={props.onKind} />}
        <div class="checks">
          <Check label="Object" checked={shown.object} onChange={(object) => onShown({ object })} />
          <Check label="Faces" checked={shown.faces} onChange={(faces) => onShown({ faces })} />
          <Check label="Face mesh" checked={shown.mesh} onChange={(mesh) => onShown({ mesh })} />
        </div>
      </div>
    </section>
  );
}
