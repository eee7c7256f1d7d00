// The map files of an estimate, by three.js's readers. Part of the chunk that is fetched late.

import { FloatType } from 'three';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { HDRLoader } from 'three/addons/loaders/HDRLoader.js';

import type { RadianceMap } from '../light/radiance_map.ts';

export function readHdr(bytes: ArrayBuffer): RadianceMap {
  const { width, height, data } = new HDRLoader().setDataType(FloatType).parse(bytes) as Parsed;
  return { width, height, rgb: withoutAlpha(data, width, (y) => y, height) };
}

// Of one channel: three that are the same.
export function readExr(bytes: ArrayBuffer): RadianceMap {
  const { width, height, data } = new EXRLoader().setDataType(FloatType).parse(bytes) as Parsed;
  // This reader puts the lowest row first, as OpenGL has it.
  return { width, height, rgb: withoutAlpha(data, width, (y) => height - 1 - y, height) };
}

interface Parsed {
  width: number;
  height: number;
  data: Float32Array; // RGBA
}

function withoutAlpha(rgba: Float32Array, width: number, rowOf: (y: number) => number, height: number): Float32Array {
  const rgb = new Float32Array(3 * width * height);
  let at = 0;
  for (let y = 0; y < height; ++y) {
    let from = 4 * width * rowOf(y);
    for (let x = 0; x < width; ++x, from += 4) {
      rgb[at++] = rgba[from]!;
      rgb[at++] = rgba[from + 1]!;
      rgb[at++] = rgba[from + 2]!;
    }
  }
  return rgb;
}
