import assert from 'node:assert/strict';
import { test } from 'node:test';

import { directionInWords, placeInWords, swatchOf, warmthInWords } from '../src/light/words.ts';

test('directions', () => {
  assert.equal(directionInWords(0, 0), 'Front, level');
  assert.equal(directionInWords(45, 20), 'Front right, a little high');
  assert.equal(directionInWords(-90, 50), 'Left, high');
  assert.equal(directionInWords(-130, -30), 'Back left, from below');
  assert.equal(directionInWords(180, 5), 'Behind the face, level');
  assert.equal(directionInWords(77, 88), 'Overhead');
});

test('places', () => {
  assert.equal(placeInWords([-0.42, 1.26, -2]), '0.4 m left, 1.3 m up, 2.0 m ahead of the camera');
});

test('colours', () => {
  assert.equal(warmthInWords([1.2, 0.95, 0.85]), 'warm');
  assert.equal(warmthInWords([1, 1, 1]), 'neutral');
  assert.equal(warmthInWords([0.8, 1, 1.1]), 'cool');
  assert.equal(swatchOf([2, 2, 2]), 'rgb(255 255 255)');
  assert.equal(swatchOf([0, 0, 0.3]), 'rgb(0 0 255)');
});
