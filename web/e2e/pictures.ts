// Photos that tests need and nobody has: drawn in the browser, on a page of the server, from its samples. And pictures back to pixels.
import type { Page } from '@playwright/test';

export interface Photo {
  name: string;
  mimeType: string;
  buffer: Buffer;
}

// `draw` runs in the page; it gets the sample photos and answers with a canvas.
type Draw = (grace: ImageBitmap, eileen: ImageBitmap) => OffscreenCanvas;

// Mirrored: as a camera sees it whose photo is the other way round.
export async function pictureOf(page: Page, draw: Draw, mirrored = false): Promise<Buffer> {
  const base64 = await page.evaluate(`(async () => {
    const sample = async (name) => createImageBitmap(await (await fetch('/api/v1/samples/' + name)).blob());
    const drawn = (${draw.toString()})(await sample('grace_hopper'), await sample('astronaut'));
    const canvas = new OffscreenCanvas(drawn.width, drawn.height);
    const context = canvas.getContext('2d');
    if (${mirrored}) context.setTransform(-1, 0, 0, 1, drawn.width, 0);
    context.drawImage(drawn, 0, 0);
    const bytes = new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
    let text = '';
    for (const byte of bytes) text += String.fromCharCode(byte);
    return btoa(text);
  })()`);
  return Buffer.from(base64 as string, 'base64');
}

// The faces about as large as one another.
export const sideBySide: Draw = (grace, eileen) => {
  const canvas = new OffscreenCanvas(1000, 560);
  const context = canvas.getContext('2d')!;
  context.drawImage(grace, 20, 60, 470, 500, 0, 0, 500, 560);
  context.drawImage(eileen, 80, 0, 280, 314, 500, 0, 500, 560);
  return canvas;
};

// One face twice: what lights the one lights the other, from the same side.
export const twice: Draw = (grace) => {
  const canvas = new OffscreenCanvas(1000, 560);
  const context = canvas.getContext('2d')!;
  for (const x of [0, 500]) context.drawImage(grace, 20, 60, 470, 500, x, 0, 500, 560);
  return canvas;
};

// As if the only lamp were red and at the right of the photo.
export const redFromTheRight: Draw = (grace) => {
  const canvas = new OffscreenCanvas(grace.width, grace.height);
  const context = canvas.getContext('2d')!;
  context.drawImage(grace, 0, 0);
  const light = context.createLinearGradient(170, 0, 355, 0); // across the face
  light.addColorStop(0, 'rgb(30 10 10)');
  light.addColorStop(1, 'rgb(255 120 110)');
  context.globalCompositeOperation = 'multiply';
  context.fillStyle = light;
  context.fillRect(0, 0, grace.width, grace.height);
  return canvas;
};

// The same lamp, but only on the face; below it an even grey that shadows are seen on.
export const faceLitFromTheRight: Draw = (grace) => {
  const canvas = new OffscreenCanvas(grace.width, grace.height);
  const context = canvas.getContext('2d')!;
  context.drawImage(grace, 0, 0);
  const light = context.createLinearGradient(170, 0, 355, 0);
  light.addColorStop(0, 'rgb(30 10 10)');
  light.addColorStop(1, 'rgb(255 120 110)');
  context.globalCompositeOperation = 'multiply';
  context.fillStyle = light;
  context.fillRect(140, 20, 250, 340);
  context.globalCompositeOperation = 'source-over';
  context.fillStyle = 'rgb(160 160 160)';
  context.fillRect(0, 400, grace.width, grace.height - 400);
  return canvas;
};

export const nobody: Draw = () => {
  const canvas = new OffscreenCanvas(240, 160);
  const context = canvas.getContext('2d')!;
  context.fillStyle = 'rgb(90 120 150)';
  context.fillRect(0, 0, 240, 160);
  return canvas;
};

export const clearly = 60; // of 255: what a thing changes where it stands, and what noise and shadows do not

export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

export interface Pixels {
  width: number;
  height: number;
  rgba: Buffer;
}

export async function decoded(page: Page, picture: Buffer): Promise<Pixels> {
  const { base64, ...size } = await page.evaluate(async (encoded) => {
    const bytes = Uint8Array.from(atob(encoded), (letter) => letter.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes]));
    const { width, height } = bitmap;
    const context = new OffscreenCanvas(width, height).getContext('2d')!;
    context.drawImage(bitmap, 0, 0);
    let text = '';
    for (const value of context.getImageData(0, 0, width, height).data) text += String.fromCharCode(value);
    return { width, height, base64: btoa(text) };
  }, picture.toString('base64'));
  return { ...size, rgba: Buffer.from(base64, 'base64') };
}

// The largest difference of two colours at one place, of 255.
export function apart(a: Pixels, b: Pixels): number {
  let most = 0;
  a.rgba.forEach((value, i) => (most = Math.max(most, Math.abs(value - b.rgba[i]!))));
  return most;
}

// Where two pictures of one size differ clearly, as shares of width and height; a hundredth of the pixels at each edge is left out.
export async function differenceOf(page: Page, a: Buffer, b: Buffer): Promise<Box> {
  const [one, other] = [await decoded(page, a), await decoded(page, b)];
  const xs: number[] = [];
  const ys: number[] = [];
  for (let i = 0; i < one.rgba.length; i += 4) {
    const differences = [0, 1, 2].map((c) => Math.abs(one.rgba[i + c]! - other.rgba[i + c]!));
    if (Math.max(...differences) < clearly) continue;
    xs.push(((i / 4) % one.width) / one.width);
    ys.push(Math.floor(i / 4 / one.width) / one.height);
  }
  xs.sort((p, q) => p - q);
  ys.sort((p, q) => p - q);
  const low = Math.floor(0.01 * xs.length);
  const high = xs.length - 1 - low;
  return { left: xs[low]!, top: ys[low]!, right: xs[high]!, bottom: ys[high]! };
}

// Width and height of a PNG.
export function sizeOfPng(bytes: Buffer): [number, number] {
  if (bytes.toString('latin1', 0, 8) !== '\x89PNG\r\n\x1a\n') throw new Error('This is no PNG.');
  return [bytes.readUInt32BE(16), bytes.readUInt32BE(20)];
}
