// Our maps as three.js's surroundings.

import {
  ClampToEdgeWrapping,
  DataTexture,
  DataUtils,
  EquirectangularReflectionMapping,
  HalfFloatType,
  LinearFilter,
  PMREMGenerator,
  RepeatWrapping,
  RGBAFormat,
  type Texture,
  type WebGLRenderer,
} from 'three';

import { columnsForThree } from '../light/columns.ts';
import type { RadianceMap } from '../light/radiance_map.ts';

const mostHalf = 65504;

// Blurred for every roughness. The caller disposes of it.
export function surroundings(renderer: WebGLRenderer, map: RadianceMap): { texture: Texture; dispose(): void } {
  const equirect = equirectTexture(map);
  const generator = new PMREMGenerator(renderer);
  const target = generator.fromEquirectangular(equirect);
  generator.dispose();
  equirect.dispose();
  return target;
}

function equirectTexture(map: RadianceMap): DataTexture {
  const rolled = columnsForThree(map.rgb, map.width, 3);
  const halves = new Uint16Array(4 * map.width * map.height);
  const one = DataUtils.toHalfFloat(1);
  for (let texel = 0; texel < map.width * map.height; ++texel) {
    for (let c = 0; c < 3; ++c) {
      halves[4 * texel + c] = DataUtils.toHalfFloat(Math.min(mostHalf, rolled[3 * texel + c]!));
    }
    halves[4 * texel + 3] = one;
  }
  const texture = new DataTexture(
    halves,
    map.width,
    map.height,
    RGBAFormat,
    HalfFloatType,
    EquirectangularReflectionMapping,
    RepeatWrapping,
    ClampToEdgeWrapping,
    LinearFilter,
    LinearFilter,
  );
  texture.flipY = true; // our first row is up
  texture.needsUpdate = true;
  return texture;
}
