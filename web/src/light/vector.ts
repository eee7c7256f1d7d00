// Vectors of the camera's frame (CONVENTIONS.md): +x right in the photo, +y up, +z towards the viewer.

export type Vec3 = readonly [number, number, number];

export function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Of linear Rec.709 light.
export function luminance(rgb: Vec3): number {
  return dot(rgb, [0.2126, 0.7152, 0.0722]);
}
