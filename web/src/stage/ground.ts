// The ground is not drawn; it takes the lamp's shadow, and darkens where the object hides the sky.

import {
  DataTexture,
  Group,
  LinearFilter,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  RGBAFormat,
  ShadowMaterial,
} from 'three';

import type { Size } from '../light/placement.ts';
import { hiddenSky, inkOf } from '../light/shadow.ts';

const shadowReach = 12; // half sides, in the object's height or width
const skyReach = 4; // half sides, in radii of the object's underside
const texels = 64;

export class Ground {
  readonly group = new Group(); // its normal is +y
  private readonly shadow = new ShadowMaterial({ depthWrite: false });
  private readonly sky = new MeshBasicMaterial({ color: 0, transparent: true, depthWrite: false });
  private readonly shadowPlane = new Mesh(flat(), this.shadow);
  private readonly skyPlane = new Mesh(flat(), this.sky);

  constructor() {
    this.shadowPlane.receiveShadow = true;
    this.shadowPlane.renderOrder = 1;
    this.group.add(this.skyPlane, this.shadowPlane);
  }

  // What the object takes of the light on the ground: of the lamp's share all, or less when light passes through it.
  setLight(lampShare: number, passing: number): void {
    this.shadow.opacity = inkOf(lampShare * (1 - passing));
    this.shadowPlane.visible = lampShare > 0;
    this.sky.alphaMap?.dispose();
    this.sky.alphaMap = skyTexture((1 - lampShare) * (1 - passing));
    this.sky.needsUpdate = true;
  }

  setSize(size: Size): void {
    const far = shadowReach * Math.max(size.width, size.height, size.depth);
    this.shadowPlane.scale.set(far, 1, far);
    this.skyPlane.scale.set((skyReach * size.width) / 2, 1, (skyReach * size.depth) / 2);
  }

  dispose(): void {
    this.sky.alphaMap?.dispose();
    this.sky.dispose();
    this.shadow.dispose();
    this.shadowPlane.geometry.dispose();
    this.skyPlane.geometry.dispose();
  }
}

// From -1 to 1 along x and z.
function flat(): PlaneGeometry {
  return new PlaneGeometry(2, 2).rotateX(-Math.PI / 2);
}

function skyTexture(skyShare: number): DataTexture {
  const values = new Uint8Array(4 * texels * texels);
  const edge = hiddenSky(skyReach);
  for (let y = 0; y < texels; ++y) {
    for (let x = 0; x < texels; ++x) {
      const distance = skyReach * Math.hypot((2 * x + 1) / texels - 1, (2 * y + 1) / texels - 1);
      const taken = skyShare * Math.max(0, hiddenSky(distance) - edge);
      values.fill(Math.round(255 * inkOf(taken)), 4 * (y * texels + x), 4 * (y * texels + x + 1));
    }
  }
  const texture = new DataTexture(values, texels, texels, RGBAFormat);
  texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
