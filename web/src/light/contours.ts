// The face mesh as a few quiet lines: the rim, eyes, brows, lips and nose, by the numbers of its 468 points. Eyes, brows and
// lips are the rings of src/face/landmark_sets.h, the left ones mirrored; the rim is the edge of the mesh, which is open there.

interface Contour {
  points: readonly number[];
  closed: boolean;
}

export const rim = [
  10, 109, 67, 103, 54, 21, 162, 127, 234, 93, 132, 58, 172, 136, 150, 149, 176, 148, 152, 377, 400, 378, 379, 365, 397,
  288, 361, 323, 454, 356, 389, 251, 284, 332, 297, 338,
];
export const rightEye = [33, 7, 163, 144, 145, 153, 154, 155, 133, 173, 157, 158, 159, 160, 161, 246];
export const leftEye = [263, 249, 390, 373, 374, 380, 381, 382, 362, 398, 384, 385, 386, 387, 388, 466];
export const rightBrow = [70, 63, 105, 66, 107, 55, 65, 52, 53, 46];
export const leftBrow = [300, 293, 334, 296, 336, 285, 295, 282, 283, 276];
export const outerLips = [61, 146, 91, 181, 84, 17, 314, 405, 321, 375, 291, 409, 270, 269, 267, 0, 37, 39, 40, 185];
export const innerLips = [78, 95, 88, 178, 87, 14, 317, 402, 318, 324, 308, 415, 310, 311, 312, 13, 82, 81, 80, 191];
export const noseRidge = [168, 6, 197, 195, 5, 4, 1, 19, 94, 2];
export const noseBase = [129, 98, 97, 2, 326, 327, 358];

const contours: readonly Contour[] = [
  ...[rim, rightEye, leftEye, rightBrow, leftBrow, outerLips, innerLips].map((points) => ({ points, closed: true })),
  ...[noseRidge, noseBase].map((points) => ({ points, closed: false })),
];

// As the path of an SVG; `mesh` is x, y of each point in turn.
export function pathOf(mesh: readonly number[]): string {
  const at = (point: number) => `${mesh[2 * point]!.toFixed(1)} ${mesh[2 * point + 1]!.toFixed(1)}`;
  return contours.map(({ points, closed }) => `M${points.map(at).join('L')}${closed ? 'Z' : ''}`).join('');
}
