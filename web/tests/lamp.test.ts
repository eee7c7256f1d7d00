import { test } from 'node:test';

import { alphaOfDisc, discRadius } from '../src/light/lamp.ts';
import { close } from './support.ts';

test('half the sphere has a radius of a right angle', () => {
  close(discRadius(2 * Math.PI), Math.PI / 2, 1e-12);
  close(discRadius(0), 0, 1e-12);
});

test('a mirror shows the widened lamp as bright as the disc is', () => {
  const solidAngle = 0.05;
  const alpha = alphaOfDisc(solidAngle);
  // Irradiance 1: GGX's peak over 4, against radiance 1 / solid angle. Discs this small are flat to a percent.
  close((1 / (4 * Math.PI * alpha * alpha)) * solidAngle, 1, 0.01);
});
