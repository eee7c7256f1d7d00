import assert from 'node:assert/strict';
import { test } from 'node:test';

import { boxOf, holds, pictureAround, rightOf, whole } from '../src/light/box.ts';
import { close } from './support.ts';

const picture = { width_px: 512, height_px: 600 };
const crop = [139, -20, 246, 265] as const; // its top is beyond the picture
const around = pictureAround(crop, picture);

// A pixel's place in the frame that the crop fills.
const seenAt = (x: number, y: number) =>
  [around.left + (x / 512) * around.width, around.top + (y / 600) * around.height] as const;

test('a part fills its frame', () => {
  const [left, top] = seenAt(139, -20);
  close(left, 0, 1e-12);
  close(top, 0, 1e-12);
  const [right, bottom] = seenAt(139 + 246, -20 + 265);
  close(right, 1, 1e-12);
  close(bottom, 1, 1e-12);
});

test('the picture keeps its shape in a frame of the part’s shape', () => {
  close((around.width * 246) / (around.height * 265), 512 / 600, 1e-12);
});

test('what a wipe hides is right of its line, whichever part is shown', () => {
  close(rightOf(0, whole), 1, 1e-12);
  close(rightOf(0.25, whole), 0.75, 1e-12);
  // A quarter of the frame is 139 + 246 / 4 px into the picture.
  close(rightOf(0.25, around), 1 - (139 + 246 / 4) / 512, 1e-12);
});

test('a box is a share of its picture, edges and all', () => {
  const box = boxOf([128, 150, 256, 300], picture);
  assert.deepEqual(box, { left: 0.25, top: 0.25, width: 0.5, height: 0.5 });
  assert.ok(holds(box, 0.25, 0.75));
  assert.ok(!holds(box, 0.76, 0.5));
  assert.ok(!holds(box, 0.5, 0.24));
});
