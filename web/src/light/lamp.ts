// A lamp that is a disc in the sky, for a renderer that knows only lamps without width.

import { within } from './within.ts';

// Half the angle, in radians, of a disc of that solid angle.
export function discRadius(solidAngleSr: number): number {
  return Math.acos(within(1 - solidAngleSr / (2 * Math.PI), -1, 1));
}

// GGX width with which a mirror shows a lamp without width as bright as the disc. Such a lobe shows irradiance E at
// E / (4 pi alpha^2), a mirror shows a disc of radius r at E / (pi r^2): equal for alpha = r / 2.
export function alphaOfDisc(solidAngleSr: number): number {
  return discRadius(solidAngleSr) / 2;
}
