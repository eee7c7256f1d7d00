// Rectangles over a picture, in shares of its width and height from the top left.

export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

// x, y, width, height, as the server says them.
type BoxPx = readonly [number, number, number, number];

interface PictureSize {
  width_px: number;
  height_px: number;
}

export const whole: Box = { left: 0, top: 0, width: 1, height: 1 };

export function boxOf([x, y, width, height]: BoxPx, picture: PictureSize): Box {
  return {
    left: x / picture.width_px,
    top: y / picture.height_px,
    width: width / picture.width_px,
    height: height / picture.height_px,
  };
}

// Where the picture lies, in shares of a frame that a part of it is to fill. The part may reach beyond the picture.
export function pictureAround([x, y, width, height]: BoxPx, picture: PictureSize): Box {
  return { left: -x / width, top: -y / height, width: picture.width_px / width, height: picture.height_px / height };
}

// How much of that picture, from its right edge and as a share of its width, is right of the frame's `share`.
export function rightOf(share: number, picture: Box): number {
  return 1 - (share - picture.left) / picture.width;
}

export function holds({ left, top, width, height }: Box, x: number, y: number): boolean {
  return x >= left && x <= left + width && y >= top && y <= top + height;
}
