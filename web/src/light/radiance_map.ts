// A lat-long map of radiance in OpenEXR's columns: row 0 is up, the centre column is +z, a quarter of the width is +x.

import { dot, type Vec3 } from './vector.ts';

export interface RadianceMap {
  readonly width: number;
  readonly height: number;
  readonly rgb: Float32Array; // linear Rec.709, row by row
}

// Azimuth (0 is +z, +90 is +x) and elevation in degrees.
export function anglesOf([x, y, z]: Vec3): [number, number] {
  return [(180 / Math.PI) * Math.atan2(x, z), (180 / Math.PI) * Math.atan2(y, Math.hypot(x, z))];
}

// Where those are seen: u from the left in [0, 1), v from the top in [0, 1].
export function uvOfAngles(azimuthDeg: number, elevationDeg: number): [number, number] {
  const u = 0.5 - azimuthDeg / 360;
  return [u - Math.floor(u), 0.5 - elevationDeg / 180];
}

export function directionOfTexel(map: RadianceMap, x: number, y: number): Vec3 {
  const azimuth = 2 * Math.PI * (0.5 - (x + 0.5) / map.width);
  const polar = (Math.PI * (y + 0.5)) / map.height;
  return [Math.sin(polar) * Math.sin(azimuth), Math.cos(polar), Math.sin(polar) * Math.cos(azimuth)];
}

// Exact: all texels together give 4 pi.
export function texelSolidAngle(map: RadianceMap, y: number): number {
  const band = Math.cos((Math.PI * y) / map.height) - Math.cos((Math.PI * (y + 1)) / map.height);
  return (2 * Math.PI * band) / map.width;
}

// What falls on a surface with that unit normal and nothing around it.
export function irradiance(map: RadianceMap, normal: Vec3): Vec3 {
  const sum: [number, number, number] = [0, 0, 0];
  for (let y = 0; y < map.height; ++y) {
    const solidAngle = texelSolidAngle(map, y);
    for (let x = 0; x < map.width; ++x) {
      const cosine = dot(normal, directionOfTexel(map, x, y));
      if (cosine <= 0) continue;
      const at = 3 * (y * map.width + x);
      for (let c = 0; c < 3; ++c) sum[c]! += cosine * solidAngle * map.rgb[at + c]!;
    }
  }
  return sum;
}
