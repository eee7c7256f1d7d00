// The faces that were found. Several can be chosen from; one is only shown.

import type { DoneEstimate, Face } from '../api/types.ts';
import type { Chosen, Subject } from '../state/workbench.ts';

interface Props {
  estimate: DoneEstimate;
  subject: Subject;
  onChoose(chosen: Chosen): void;
}

export function FaceBoxes({ estimate, subject, onChoose }: Props) {
  const { faces, photo } = estimate;
  if (faces.length === 1) return <div class="face-box" style={placeOf(faces[0]!, photo)} />;
  return (
    <div role="group" aria-label="Faces in the photo">
      {faces.map((face, index) => (
        <button
          key={index}
          type="button"
          class="face-box"
          style={placeOf(face, photo)}
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

function placeOf({ box_px: [x, y, width, height] }: Face, photo: DoneEstimate['photo']) {
  const share = (part: number, whole: number) => `${(100 * part) / whole}%`;
  return {
    left: share(x, photo.width_px),
    top: share(y, photo.height_px),
    width: share(width, photo.width_px),
    height: share(height, photo.height_px),
  };
}
