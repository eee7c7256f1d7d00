import assert from 'node:assert/strict';
import { test } from 'node:test';

import { columnsForThree, rollColumns } from '../src/light/columns.ts';
import type { Vec3 } from '../src/light/vector.ts';
import { uvOf } from './support.ts';

const width = 16;
const height = 8;

// Where three.js looks a direction up: `equirectUv` of its shader chunk `common`, with v from the top.
function equirectUv([x, y, z]: Vec3): [number, number] {
  return [Math.atan2(z, x) / (2 * Math.PI) + 0.5, 0.5 - Math.asin(y) / Math.PI];
}

function texelAt([u, v]: [number, number]): number {
  return Math.floor(v * height) * width + (Math.floor(u * width) % width);
}

test('a lamp of our map is found by three.js where it is', () => {
  const lamps: Vec3[] = [
    [1, 0, 0],
    [-1, 0, 0],
    [0, 0, 1],
    [0, 0, -1],
    [0.6, 0, 0.8],
    [-0.48, 0.6, 0.64],
  ];
  for (const lamp of lamps) {
    const ours = new Float32Array(width * height * 3);
    ours[3 * texelAt(uvOf(lamp))] = 8;
    const theirs = columnsForThree(ours, width, 3);
    assert.equal(theirs[3 * texelAt(equirectUv(lamp))], 8, `lamp at ${lamp}`);
    assert.equal(
      theirs.reduce((sum, value) => sum + value),
      8,
    );
  }
});

test('a red lamp at camera right: a quarter of our width, the centre of theirs', () => {
  const ours = new Float32Array(width * 3);
  ours[3 * (width / 4)] = 1;
  const theirs = columnsForThree(ours, width, 3);
  assert.equal(theirs.indexOf(1), 3 * (width / 2));
});

test('a roll goes round, both ways, and back', () => {
  const values = Float32Array.from({ length: 24 }, (_, i) => i);
  assert.deepEqual([...rollColumns(values, 4, 3, 1)].slice(0, 6), [9, 10, 11, 0, 1, 2]);
  assert.deepEqual(rollColumns(rollColumns(values, 4, 3, 3), 4, 3, -3), values);
  assert.deepEqual(rollColumns(values, 4, 3, 8), values);
});

test('a map that is not whole rows, or has no quarter, is refused', () => {
  assert.throws(() => rollColumns(new Float32Array(10), 4, 3, 1), RangeError);
  assert.throws(() => columnsForThree(new Float32Array(18), 6, 3), RangeError);
});
