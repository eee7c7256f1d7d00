// Directions, places and colours as people say them.

import { srgbFromLinear } from './exposure.ts';
import type { Vec3 } from './vector.ts';

// Seen from the photo: azimuth 0 is the camera's side, +90 the right of the photo.
export function directionInWords(azimuthDeg: number, elevationDeg: number): string {
  if (elevationDeg >= 70) return 'Overhead';
  if (elevationDeg <= -70) return 'From straight below';
  const around = Math.abs(azimuthDeg);
  const side = azimuthDeg > 0 ? 'right' : 'left';
  let where = 'Behind the face';
  if (around < 22.5) where = 'Front';
  else if (around < 67.5) where = `Front ${side}`;
  else if (around < 112.5) where = side === 'right' ? 'Right' : 'Left';
  else if (around < 157.5) where = `Back ${side}`;
  if (elevationDeg >= 40) return `${where}, high`;
  if (elevationDeg >= 12) return `${where}, a little high`;
  if (elevationDeg <= -12) return `${where}, from below`;
  return `${where}, level`;
}

// From the camera, in metres.
export function placeInWords([x, y, z]: Vec3): string {
  const metres = (value: number) => `${Math.abs(value).toFixed(1)} m`;
  return [
    `${metres(x)} ${x < 0 ? 'left' : 'right'}`,
    `${metres(y)} ${y < 0 ? 'down' : 'up'}`,
    `${metres(z)} ${z < 0 ? 'ahead' : 'behind'} of the camera`,
  ].join(', ');
}

// Of light: by how much more red than blue it has.
export function warmthInWords([r, , b]: Vec3): string {
  const ratio = r / Math.max(b, 1e-6);
  if (ratio > 2) return 'very warm';
  if (ratio > 1.15) return 'warm';
  if (ratio < 0.5) return 'very cool';
  if (ratio < 0.87) return 'cool';
  return 'neutral';
}

// A light's hue at full brightness, as CSS wants it.
export function swatchOf(rgb: Vec3): string {
  const brightest = Math.max(...rgb, 1e-6);
  const channels = rgb.map((value) => Math.round(255 * srgbFromLinear(value / brightest)));
  return `rgb(${channels.join(' ')})`;
}
