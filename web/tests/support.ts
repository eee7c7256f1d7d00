import assert from 'node:assert/strict';

import type { RadianceMap } from '../src/light/radiance_map.ts';

export function close(found: number, expected: number, tolerance: number): void {
  assert.ok(Math.abs(found - expected) <= tolerance, `found ${found}, expected ${expected} within ${tolerance}`);
}

export function evenMap(radiance: number): RadianceMap {
  return { width: 32, height: 16, rgb: new Float32Array(3 * 32 * 16).fill(radiance) };
}
