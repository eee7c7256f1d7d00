import assert from 'node:assert/strict';
import { test } from 'node:test';

import { fieldOfViewDeg, pointAt } from '../src/light/camera.ts';
import { farther, moved, outlineOf, placementAt, reshaped, sizeOf, turned } from '../src/light/placement.ts';
import { close } from './support.ts';

const camera = { widthPx: 640, heightPx: 480, focalPx: 600 };

test('a point is that far ahead, and seen at its pixel', () => {
  for (const pixel of [
    [0, 0],
    [320, 240],
    [601.5, 17.25],
  ] as const) {
    const [x, y, z] = pointAt(camera, pixel, 0.7);
    assert.equal(z, -0.7);
    close(320 + (600 * x) / 0.7, pixel[0], 1e-9);
    close(240 - (600 * y) / 0.7, pixel[1], 1e-9);
  }
});

test('right in the photo is +x, up is +y, ahead is -z', () => {
  assert.deepEqual(pointAt(camera, [320 + 60, 240 - 30], 2), [0.2, 0.1, -2]);
});

test('the field of view is that of the whole height', () => {
  close(fieldOfViewDeg({ widthPx: 100, heightPx: 200, focalPx: 100 }), 90, 1e-9);
});

test('a drag moves the foot by its pixels and keeps it in the photo', () => {
  const start = placementAt({ at_px: [600, 400], distance_m: 0.5, height_m: 0.1 }, { width: 1, height: 1, depth: 1 });
  assert.deepEqual(moved(start, camera, [-20, 30]).atPx, [580, 430]);
  assert.deepEqual(moved(start, camera, [999, 999]).atPx, [640, 480]);
  assert.equal(moved(start, camera, [-20, 30]).distanceM, 0.5);
});

test('things of other shapes take the same room', () => {
  const spot = { at_px: [10, 20], distance_m: 0.5, height_m: 0.1 } as const;
  const tall = placementAt(spot, { width: 0.2, height: 1, depth: 0.2 });
  const wide = placementAt(spot, { width: 3, height: 1, depth: 1 });
  close(tall.heightM, 0.1 * Math.SQRT2, 1e-12);
  close(wide.heightM * Math.hypot(3, 1), 0.1 * Math.SQRT2, 1e-12);
  const back = reshaped(
    reshaped(tall, { width: 0.2, height: 1, depth: 0.2 }, { width: 3, height: 1, depth: 1 }),
    { width: 3, height: 1, depth: 1 },
    { width: 0.2, height: 1, depth: 0.2 },
  );
  close(back.heightM, tall.heightM, 1e-12);
});

test('distance has ends, turns go round', () => {
  const start = placementAt({ at_px: [0, 0], distance_m: 1, height_m: 0.1 }, { width: 1, height: 1, depth: 1 });
  assert.equal(farther(start, 1.5, 1).distanceM, 1.5);
  assert.equal(farther(start, 100, 1).distanceM, 4);
  assert.equal(farther(start, 0.001, 1).distanceM, 0.25);
  assert.equal(turned(turned(start, 170), 20).turnDeg, -170);
  assert.equal(turned(start, -180).turnDeg, 180);
});

test('a size is that of all meshes together', () => {
  const meshes = [{ positions: [-1, 0, 0, 1, 2, 0] }, { positions: [0, 3, -0.5, 0, 1, 0.25] }];
  assert.deepEqual(sizeOf(meshes), { width: 2, height: 3, depth: 0.75 });
});

test('an outline stands on the foot and is as high as the thing is seen', () => {
  const size = { width: 2, height: 1, depth: 1 };
  const outline = outlineOf({ atPx: [320, 240], distanceM: 1, heightM: 0.1, turnDeg: 0 }, size, camera);
  // 0.1 m at 1 m with 600 px: 60 px high, 120 px wide.
  assert.deepEqual(outline, { left: 260 / 640, top: 180 / 480, width: 120 / 640, height: 60 / 480 });
});
