import assert from 'node:assert/strict';
import { test } from 'node:test';

import { srgbFromLinear } from '../src/light/exposure.ts';
import { hiddenSky, inkOf, lampShare } from '../src/light/shadow.ts';
import { close, evenMap } from './support.ts';

const up = [0, 1, 0] as const;

test('a lamp in the dark has all the light on the ground', () => {
  assert.equal(lampShare({ direction: [0.6, 0.8, 0], irradiance: 0.01 }, evenMap(0), up), 1);
});

test('under an even sky a lamp has the share that its cosine gives it', () => {
  // Overhead lamp of pi against a sky of pi: half; at 60 degrees from up it gives half of that: a third.
  close(lampShare({ direction: up, irradiance: Math.PI }, evenMap(1), up), 1 / 2, 0.005);
  close(lampShare({ direction: [Math.sqrt(0.75), 0.5, 0], irradiance: Math.PI }, evenMap(1), up), 1 / 3, 0.005);
  assert.ok(lampShare({ direction: up, irradiance: 0.02 }, evenMap(1), up) < 0.01);
});

test('a lamp under the ground, and none at all, cast no shadow', () => {
  assert.equal(lampShare({ direction: [0, -1, 0], irradiance: 5 }, evenMap(0), up), 0);
  assert.equal(lampShare({ direction: up, irradiance: 0 }, evenMap(0), up), 0);
});

test('ink over white leaves the light that is not taken', () => {
  close(inkOf(0), 0, 1e-12);
  assert.equal(inkOf(1), 1);
  for (const taken of [0.1, 0.5, 0.9]) close(1 - inkOf(taken), srgbFromLinear(1 - taken), 1e-12);
  assert.ok(inkOf(0.5) < 0.5, 'encoded values are brighter than light');
});

test('a ball hides all the sky at its foot and none far away', () => {
  assert.equal(hiddenSky(0), 1);
  close(hiddenSky(1), 2 ** -1.5, 1e-12);
  assert.ok(hiddenSky(5) < 0.01);
});
