// The keyboard over the picture: arrows move, + and - bring nearer and take farther, [ and ] turn; with Shift in larger steps.

import type { PhotoCamera } from '../light/camera.ts';
import { farther, moved, turned, type Placement } from '../light/placement.ts';

const stepShare = 0.01; // of the photo's longer side
const stepFactor = 1.03;
const stepDeg = 5;
const larger = 5;

export function changeOfKey(
  key: string,
  shift: boolean,
  camera: PhotoCamera,
  spotM: number,
): ((placement: Placement) => Placement) | undefined {
  const step = stepShare * Math.max(camera.widthPx, camera.heightPx) * (shift ? larger : 1);
  switch (key) {
    case 'ArrowLeft':
      return (placement) => moved(placement, camera, [-step, 0]);
    case 'ArrowRight':
      return (placement) => moved(placement, camera, [step, 0]);
    case 'ArrowUp':
      return (placement) => moved(placement, camera, [0, -step]);
    case 'ArrowDown':
      return (placement) => moved(placement, camera, [0, step]);
    // On many keyboards + is on Shift and =.
    case '+':
    case '=':
      return (placement) => farther(placement, 1 / stepFactor, spotM);
    case '-':
    case '_':
      return (placement) => farther(placement, stepFactor, spotM);
    case '[':
    case '{':
      return (placement) => turned(placement, shift ? -larger * stepDeg : -stepDeg);
    case ']':
    case '}':
      return (placement) => turned(placement, shift ? larger * stepDeg : stepDeg);
    default:
      return undefined;
  }
}
