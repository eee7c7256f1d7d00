// The main lamp: a directional light with a shadow as soft as the lamp is wide.

import { Color, DirectionalLight, type Sphere, Vector3 } from 'three';

import type { MainLight } from '../api/types.ts';
import { discRadius } from '../light/lamp.ts';
import { within } from '../light/within.ts';

const mapSize = 256; // small, because the blur's reach is in its texels
const away = 4; // radii of the object, from the lamp to its middle
const behind = 16; // radii, how far shadows reach
const widest = 40; // texels; the blur's samples are too few for more

export function lampOf(light: MainLight): DirectionalLight {
  const lamp = new DirectionalLight(new Color(...light.colour_rgb), light.irradiance);
  lamp.castShadow = true;
  lamp.shadow.mapSize.set(mapSize, mapSize);
  lamp.shadow.blurSamples = 25;
  return lamp;
}

// Everything that casts a shadow is inside `ball`.
export function aim(lamp: DirectionalLight, light: MainLight, ball: Sphere): void {
  lamp.position.copy(ball.center).addScaledVector(new Vector3(...light.direction), away * ball.radius);
  lamp.target.position.copy(ball.center);
  lamp.target.updateMatrixWorld();
  // Room for the blur at the sides.
  const half = 1.6 * ball.radius;
  const camera = lamp.shadow.camera;
  Object.assign(camera, { left: -half, right: half, top: half, bottom: -half });
  Object.assign(camera, { near: 0.1 * ball.radius, far: (away + behind) * ball.radius });
  camera.updateProjectionMatrix();
  // Half shadow of what is half a radius away.
  const penumbra = 0.5 * ball.radius * Math.tan(Math.min(1, discRadius(light.solid_angle_sr)));
  lamp.shadow.radius = within((penumbra / (2 * half)) * mapSize, 1, widest);
  lamp.shadow.normalBias = 0.02 * ball.radius;
}
