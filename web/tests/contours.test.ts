import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import * as contours from '../src/light/contours.ts';

// The owner of the rings.
const sets = readFileSync(new URL('../../../src/face/landmark_sets.h', import.meta.url), 'utf8');

function setNamed(name: string): number[] {
  const found = new RegExp(`${name} = \\{([\\d,\\s]+)\\}`).exec(sets);
  assert.ok(found, `${name} is not in landmark_sets.h`);
  return found[1]!.split(',').map(Number);
}

test('rings are those of the face mesh', () => {
  assert.deepEqual(contours.rightEye, setNamed('kRightEyeRing'));
  assert.deepEqual(contours.rightBrow, setNamed('kRightBrowRing'));
  assert.deepEqual(contours.outerLips, setNamed('kOuterLipRing'));
  assert.deepEqual(contours.innerLips, setNamed('kInnerLipRing'));
});

test('each line visits points of the mesh, none twice', () => {
  const { pathOf: _, ...lines } = contours;
  for (const [name, points] of Object.entries(lines)) {
    assert.equal(new Set(points).size, points.length, name);
    assert.ok(Math.min(...points) >= 0 && Math.max(...points) < 468, name);
  }
});

test('a path goes through the points’ pixels, and closes what is closed', () => {
  // Point i is at (i, 1000 - i).
  const path = contours.pathOf(Array.from({ length: 936 }, (_, i) => (i % 2 === 0 ? i / 2 : 1000 - (i - 1) / 2)));
  assert.ok(path.startsWith('M10.0 990.0L109.0 891.0L67.0 933.0'));
  assert.equal(path.match(/M/g)!.length, 9);
  assert.equal(path.match(/Z/g)!.length, 7);
  assert.ok(path.endsWith('L358.0 642.0'));
});
