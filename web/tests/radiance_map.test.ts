import assert from 'node:assert/strict';
import { test } from 'node:test';

import {
  anglesOf,
  directionOfTexel,
  irradiance,
  texelSolidAngle,
  uvOfAngles,
  type RadianceMap,
} from '../src/light/radiance_map.ts';
import { dot } from '../src/light/vector.ts';
import { close, evenMap, uvOf } from './support.ts';

test('directions are where CONVENTIONS.md says', () => {
  const places = [
    { direction: [1, 0, 0], uv: [0.25, 0.5] },
    { direction: [0, 0, 1], uv: [0.5, 0.5] },
    { direction: [-1, 0, 0], uv: [0.75, 0.5] },
    { direction: [0, 1, 0], uv: [0.5, 0] },
  ] as const;
  for (const { direction, uv } of places) assert.deepEqual(uvOf(direction), uv);
  assert.deepEqual(anglesOf([2, 0, 0]), [90, 0]);
  assert.deepEqual(anglesOf([0, 3, 0]), [0, 90]);
  assert.deepEqual(uvOfAngles(90, 0), [0.25, 0.5]);
  assert.deepEqual(uvOfAngles(0, 90), [0.5, 0]);
});

test('a texel is where its direction is seen', () => {
  const map = evenMap(1);
  for (const [x, y] of [
    [0, 0],
    [5, 3],
    [20, 9],
    [31, 15],
  ] as const) {
    const direction = directionOfTexel(map, x, y);
    close(dot(direction, direction), 1, 1e-12);
    const [u, v] = uvOf(direction);
    close(u * map.width, x + 0.5, 1e-9);
    close(v * map.height, y + 0.5, 1e-9);
  }
});

test('all texels make a sphere', () => {
  const map = evenMap(1);
  let sum = 0;
  for (let y = 0; y < map.height; ++y) sum += map.width * texelSolidAngle(map, y);
  close(sum, 4 * Math.PI, 1e-9);
});

test('an even sky of radiance 1 gives pi, whatever the normal', () => {
  // Cosines at texel centres, of which the map has 512: a percent.
  for (const normal of [
    [0, 1, 0],
    [1, 0, 0],
    [0, 0.6, -0.8],
  ] as const) {
    close(irradiance(evenMap(1), normal)[1], Math.PI, 0.03);
  }
});

test('one bright texel gives radiance times solid angle times cosine', () => {
  const map: RadianceMap = evenMap(0);
  map.rgb[3 * (4 * map.width + 8)] = 10;
  const lamp = directionOfTexel(map, 8, 4);
  const [r, g, b] = irradiance(map, [0, 1, 0]);
  close(r, 10 * texelSolidAngle(map, 4) * lamp[1], 1e-9);
  assert.deepEqual([g, b], [0, 0]);
  assert.deepEqual(irradiance(map, [0, -1, 0]), [0, 0, 0]);
});
