import assert from 'node:assert/strict';

import { anglesOf, uvOfAngles, type RadianceMap } from '../src/light/radiance_map.ts';
import type { Vec3 } from '../src/light/vector.ts';

export function close(found: number, expected: number, tolerance: number): void {
  assert.ok(Math.abs(found - expected) <= tolerance, `found ${found}, expected ${expected} within ${tolerance}`);
}

export function evenMap(radiance: number): RadianceMap {
  return { width: 32, height: 16, rgb: new Float32Array(3 * 32 * 16).fill(radiance) };
}

export function uvOf(direction: Vec3): [number, number] {
  return uvOfAngles(...anglesOf(direction));
}
