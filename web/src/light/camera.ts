// The photo's camera: at the origin, looking along -z, its axis through the middle of the photo.

import type { Vec3 } from './vector.ts';

export interface PhotoCamera {
  widthPx: number;
  heightPx: number;
  focalPx: number;
}

export type Pixel = readonly [number, number];

// Of the whole height, as three.js wants it.
export function fieldOfViewDeg(camera: PhotoCamera): number {
  return (360 / Math.PI) * Math.atan(camera.heightPx / (2 * camera.focalPx));
}

// The point that is seen at a pixel, that far along the camera's axis.
export function pointAt(camera: PhotoCamera, [x, y]: Pixel, distanceM: number): Vec3 {
  return [
    (distanceM * (x - camera.widthPx / 2)) / camera.focalPx,
    (distanceM * (camera.heightPx / 2 - y)) / camera.focalPx,
    -distanceM,
  ];
}
