// Where a thing stands in the photo, as the server's insertions take it.

import type { Box } from './box.ts';
import type { PhotoCamera, Pixel } from './camera.ts';
import { within } from './within.ts';

export interface Placement {
  atPx: Pixel; // where its foot is seen
  distanceM: number; // of its foot, along the camera's axis
  heightM: number;
  turnDeg: number;
}

export interface Size {
  width: number;
  height: number;
  depth: number;
}

// Things of different shapes take about the same room when this stays: their height, or the diagonal of their underside.
function roomPerHeight(size: Size): number {
  return Math.max(1, Math.hypot(size.width, size.depth) / size.height);
}

const cube: Size = { width: 1, height: 1, depth: 1 };

// `spot` says where a cube of its height would stand.
export function placementAt(spot: { at_px: Pixel; distance_m: number; height_m: number }, size: Size): Placement {
  return reshaped({ atPx: spot.at_px, distanceM: spot.distance_m, heightM: spot.height_m, turnDeg: 0 }, cube, size);
}

// The same room for a thing of another shape.
export function reshaped(placement: Placement, from: Size, to: Size): Placement {
  return { ...placement, heightM: (placement.heightM * roomPerHeight(from)) / roomPerHeight(to) };
}

// Its foot moved over the photo, at constant depth, and kept inside.
export function moved(placement: Placement, camera: PhotoCamera, [dx, dy]: Pixel): Placement {
  const atPx: Pixel = [
    within(placement.atPx[0] + dx, 0, camera.widthPx),
    within(placement.atPx[1] + dy, 0, camera.heightPx),
  ];
  return { ...placement, atPx };
}

// A thing's box over the photo, as if it were seen from straight ahead at its foot's distance.
export function outlineOf(placement: Placement, size: Size, camera: PhotoCamera): Box {
  const heightPx = (placement.heightM * camera.focalPx) / placement.distanceM;
  const widthPx = (heightPx * size.width) / size.height;
  return {
    left: (placement.atPx[0] - widthPx / 2) / camera.widthPx,
    top: (placement.atPx[1] - heightPx) / camera.heightPx,
    width: widthPx / camera.widthPx,
    height: heightPx / camera.heightPx,
  };
}

// Of all vertices, x, y, z in turn.
export function sizeOf(meshes: { positions: readonly number[] }[]): Size {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const { positions } of meshes) {
    positions.forEach((value, i) => {
      low[i % 3] = Math.min(low[i % 3]!, value);
      high[i % 3] = Math.max(high[i % 3]!, value);
    });
  }
  return { width: high[0]! - low[0]!, height: high[1]! - low[1]!, depth: high[2]! - low[2]! };
}

// How far things may go from where they began, either way.
export const reach = 4;

export function farther(placement: Placement, factor: number, spotM: number): Placement {
  return { ...placement, distanceM: within(placement.distanceM * factor, spotM / reach, spotM * reach) };
}

// Into (-180, 180].
export function turned(placement: Placement, byDeg: number): Placement {
  const turn = (placement.turnDeg + byDeg) % 360;
  return { ...placement, turnDeg: turn > 180 ? turn - 360 : turn <= -180 ? turn + 360 : turn };
}
