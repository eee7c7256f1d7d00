import assert from 'node:assert/strict';
import { test } from 'node:test';

import { developed, fittingStops, gainOfStops, shoulder, srgbFromLinear } from '../src/light/exposure.ts';
import type { RadianceMap } from '../src/light/radiance_map.ts';
import { close, evenMap } from './support.ts';

test('a stop doubles', () => {
  assert.equal(gainOfStops(0), 1);
  assert.equal(gainOfStops(3), 8);
  assert.equal(gainOfStops(-1), 0.5);
});

test('sRGB: mid grey, ends, and no light below none', () => {
  assert.equal(srgbFromLinear(0), 0);
  close(srgbFromLinear(1), 1, 1e-12);
  close(srgbFromLinear(0.2140411), 0.5, 1e-6);
  assert.equal(srgbFromLinear(-1), 0);
});

test('the shoulder leaves dark and middle tones, grows without a step, and stays below 1', () => {
  assert.equal(shoulder(0.5), 0.5);
  close(shoulder(0.7500001), 0.75, 1e-6);
  let before = 0;
  for (let value = 0.01; value < 4; value += 0.01) {
    assert.ok(shoulder(value) > before && shoulder(value) < 1);
    before = shoulder(value);
  }
});

test('an even map is one grey, a stop up is the grey of twice the light', () => {
  const plain = developed(evenMap(0.1), 1, 8, 4);
  const double = developed(evenMap(0.2), 0, 8, 4);
  assert.deepEqual(plain, double);
  assert.deepEqual([...plain.slice(0, 4)], [124, 124, 124, 255]); // 255 x 0.4845, the sRGB value of 0.2
});

test('a bright texel stays where it is, and bleeds over the seam of the map', () => {
  const map: RadianceMap = { width: 8, height: 4, rgb: new Float32Array(3 * 32) };
  map.rgb[3 * 8 * 2] = 0.5; // leftmost of the third row
  const same = developed(map, 0, 8, 4);
  assert.ok(same[4 * 8 * 2]! > 180 && same[4 * 8 * 2 + 1] === 0);
  const twice = developed(map, 0, 16, 8);
  const row = 4 * 16 * 4;
  assert.ok(twice[row]! > 0 && twice[row + 4 * 15]! > 0, 'both sides of the seam');
  assert.equal(twice[row + 4 * 8], 0);
});

test('a bright map is taken down to fit, by half stops; a dark one stays dark', () => {
  assert.equal(fittingStops(evenMap(0.1)), 0);
  assert.equal(fittingStops(evenMap(3.1)), -2);
  assert.equal(fittingStops(evenMap(3.3)), -2.5);
  const lamp = evenMap(0.5);
  lamp.rgb[0] = 1000; // one lamp may burn out
  assert.equal(fittingStops(lamp), 0);
});
