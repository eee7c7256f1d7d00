// From linear light to what a screen shows.

import type { RadianceMap } from './radiance_map.ts';
import { within } from './within.ts';

// The sRGB curve; 0 and 1 stay.
export function srgbFromLinear(value: number): number {
  const v = within(value, 0, 1);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
}

const knee = 0.75;

// Identity up to the knee, so that what is not bright keeps the photo's colours; what is brighter nears 1 and never gets there.
export function shoulder(value: number): number {
  return value <= knee ? value : 1 - (1 - knee) * Math.exp((knee - value) / (1 - knee));
}

export function gainOfStops(stops: number): number {
  return 2 ** stops;
}

const brightShare = 0.05; // of the map's texels, that may be brighter than the shoulder shows well
const bright = 0.8;

// Stops, in halves and never upwards, that show the map's bright parts below white.
export function fittingStops(map: RadianceMap): number {
  const brightness = Float32Array.from({ length: map.rgb.length / 3 }, (_, i) =>
    Math.max(map.rgb[3 * i]!, map.rgb[3 * i + 1]!, map.rgb[3 * i + 2]!),
  ).sort();
  const high = brightness[Math.floor((1 - brightShare) * (brightness.length - 1))]!;
  return high > bright ? Math.floor(2 * Math.log2(bright / high)) / 2 : 0;
}

// The map as pixels of a canvas, width x height RGBA: exposed by that many stops, then through shoulder and sRGB curve.
export function developed(
  map: RadianceMap,
  stops: number,
  width: number,
  height: number,
): Uint8ClampedArray<ArrayBuffer> {
  const gain = gainOfStops(stops);
  const pixels = new Uint8ClampedArray(4 * width * height);
  const columns = samplesOf(width, map.width, (i, count) => (i + count) % count);
  const rows = samplesOf(height, map.height, (i, count) => within(i, 0, count - 1));
  let at = 0;
  for (const row of rows) {
    const low = 3 * map.width * row.low;
    const high = 3 * map.width * row.high;
    for (const column of columns) {
      const left = 3 * column.low;
      const right = 3 * column.high;
      for (let c = 0; c < 3; ++c) {
        const above = mix(map.rgb[low + left + c]!, map.rgb[low + right + c]!, column.share);
        const below = mix(map.rgb[high + left + c]!, map.rgb[high + right + c]!, column.share);
        pixels[at++] = 255 * srgbFromLinear(shoulder(gain * mix(above, below, row.share)));
      }
      pixels[at++] = 255;
    }
  }
  return pixels;
}

interface Sample {
  low: number;
  high: number;
  share: number; // of high
}

// Which two texels each of `count` pixel centres lies between.
function samplesOf(count: number, texels: number, into: (index: number, count: number) => number): Sample[] {
  return Array.from({ length: count }, (_, i) => {
    const place = ((i + 0.5) * texels) / count - 0.5;
    const low = Math.floor(place);
    return { low: into(low, texels), high: into(low + 1, texels), share: place - low };
  });
}

function mix(a: number, b: number, share: number): number {
  return a + share * (b - a);
}
