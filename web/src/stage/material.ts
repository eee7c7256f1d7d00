// The server's materials as three.js's.

import { Color, MeshPhysicalMaterial, ShaderChunk } from 'three';

import type { Material } from '../api/types.ts';

// Shared by all materials of a stage: the width of the main lamp, as GGX has it (light/lamp.ts).
export interface LampWidth {
  value: number;
}

export function surfaceOf(material: Material, lampWidth: LampWidth): MeshPhysicalMaterial {
  const surface = new MeshPhysicalMaterial({ color: new Color(...material.colour_rgb) });
  switch (material.kind) {
    case 'diffuse':
      surface.roughness = 1;
      surface.specularIntensity = 0;
      break;
    case 'metal':
      surface.metalness = 1;
      surface.roughness = material.roughness;
      break;
    case 'plastic':
      surface.roughness = material.roughness;
      surface.ior = material.index;
      break;
    case 'glass':
      surface.roughness = 0;
      surface.ior = material.index;
      surface.transmission = 1;
      surface.thickness = 0.5; // of objects that are about 1 high
      break;
  }
  widenHighlights(surface, lampWidth);
  return surface;
}

// three.js gives the highlights of lamps without width a least roughness; here they get the width of the lamp instead, so that
// it shows in shiny things as the soft spot that it is.
const leastRoughness = 'float roughness = max( material.roughness, 0.045 );';
const widenedRoughness = 'float roughness = sqrt( length( vec2( pow2( material.roughness ), lampWidth ) ) );';

function widenHighlights(surface: MeshPhysicalMaterial, lampWidth: LampWidth): void {
  surface.onBeforeCompile = (shader) => {
    const chunk = ShaderChunk.lights_physical_pars_fragment;
    if (!chunk.includes(leastRoughness)) throw new Error('This version of three.js has another shader for highlights.');
    shader.uniforms['lampWidth'] = lampWidth;
    shader.fragmentShader = shader.fragmentShader.replace(
      '#include <lights_physical_pars_fragment>',
      `uniform float lampWidth;\n${chunk.replace(leastRoughness, widenedRoughness)}`,
    );
  };
}
