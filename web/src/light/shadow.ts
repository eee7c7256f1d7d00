// What a thing takes from the light on the ground it stands on.

import { srgbFromLinear } from './exposure.ts';
import { irradiance, type RadianceMap } from './radiance_map.ts';
import { dot, luminance, type Vec3 } from './vector.ts';
import { within } from './within.ts';

interface DistantLamp {
  direction: Vec3; // unit, towards the lamp
  irradiance: number; // luminance, on a surface that faces it
}

// Share of the light on a ground with that normal that comes from the lamp, 0 to 1; `rest` is the map without it.
export function lampShare(lamp: DistantLamp, rest: RadianceMap, up: Vec3): number {
  const fromLamp = lamp.irradiance * Math.max(0, dot(lamp.direction, up));
  const fromRest = luminance(irradiance(rest, up));
  return fromLamp > 0 ? fromLamp / (fromLamp + fromRest) : 0;
}

// How opaque black must lie over a photo so that, where it is full, 1 - `taken` of the light is left. Canvases blend encoded
// values; 1 - taken of a white's light is encoded so, and of darker tones nearly.
export function inkOf(taken: number): number {
  return 1 - srgbFromLinear(1 - within(taken, 0, 1));
}

// Share of an even sky that a ball of radius 1 on the ground hides from a place that far from its foot: all below it, and less
// and less outside (the ball's form factor, h r^2 / (d^2 + h^2)^(3/2) with h = r).
export function hiddenSky(distance: number): number {
  return (distance * distance + 1) ** -1.5;
}
