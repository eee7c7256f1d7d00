// The page's parts by the names that people hear, and what is done with them again and again.
import { expect, type Locator, type Page, type TestInfo } from '@playwright/test';
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';

import type { Photo } from './pictures.ts';

export const partsOf = (page: Page) => ({
  photoFile: page.locator('input[type=file]'),
  photoName: page.locator('header h2'),
  estimating: page.getByRole('progressbar', { name: 'Estimating the light' }),
  chooseAnother: page.getByRole('button', { name: 'Choose another photo' }),
  frame: page.locator('.frame'),
  photo: page.getByRole('img', { name: /^The photo: / }),
  thing: page.getByRole('application', { name: 'Object in the photo' }),
  objectShown: page.getByRole('checkbox', { name: 'Object', exact: true }),
  facesShown: page.getByRole('checkbox', { name: 'Faces', exact: true }),
  readyStage: page.locator('canvas.stage[data-ready=true]'),
  render: page.getByRole('button', { name: 'Render', exact: true }),
  rendering: page.getByRole('progressbar', { name: 'Rendering' }),
  rendered: page.getByRole('img', { name: 'The photo with the object, rendered' }),
  panorama: page.getByRole('img', { name: /^Panorama of the light/ }),
  light: page.getByRole('region', { name: 'Light', exact: true }),
  history: page.getByRole('region', { name: 'Photos of this session' }),
});

export async function openEstimate(page: Page, id: string): Promise<void> {
  await page.goto(`/?estimate=${id}`);
  await expectMap(page);
}

// The panorama is drawn: its pixels are there, and not all alike.
export async function expectMap(page: Page): Promise<void> {
  const { panorama } = partsOf(page);
  await expect.poll(async () => ((await panorama.count()) ? spreadOf(await pixelsOf(page)) : 0)).toBeGreaterThan(20);
}

// RGBA of the panorama's 512 x 256 pixels.
export async function pixelsOf(page: Page, canvas = partsOf(page).panorama): Promise<Uint8Array> {
  // As text: half a million numbers, one by one, take seconds to get here.
  const base64 = await canvas.evaluate((shown: HTMLCanvasElement) => {
    const { data } = shown.getContext('2d')!.getImageData(0, 0, shown.width, shown.height);
    let text = '';
    for (const value of data) text += String.fromCharCode(value);
    return btoa(text);
  });
  return Buffer.from(base64, 'base64');
}

function spreadOf(rgba: Uint8Array): number {
  let low = 255;
  let high = 0;
  for (let i = 0; i < rgba.length; i += 4) {
    if (rgba[i + 3] === 0) return 0;
    low = Math.min(low, rgba[i]!);
    high = Math.max(high, rgba[i]!);
  }
  return high - low;
}

// As a file manager drops it on the page.
export async function drop(page: Page, photo: Photo): Promise<void> {
  const transfer = await page.evaluateHandle(
    ({ name, mimeType, base64 }) => {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const files = new DataTransfer();
      files.items.add(new File([bytes], name, { type: mimeType }));
      return files;
    },
    { name: photo.name, mimeType: photo.mimeType, base64: photo.buffer.toString('base64') },
  );
  await page.locator('body').dispatchEvent('dragover', { dataTransfer: transfer });
  await page.locator('body').dispatchEvent('drop', { dataTransfer: transfer });
}

// A part once it has stopped to change, for what fades in or takes its time to be drawn; if `unlike` is given, not before it is another.
export async function steady(part: Locator, unlike?: Buffer): Promise<Buffer> {
  let last: Buffer = Buffer.alloc(0);
  let alike = 0;
  const look = async () => {
    const now = await part.screenshot();
    alike = now.equals(last) && !unlike?.equals(now) ? alike + 1 : 0;
    last = now;
    return alike;
  };
  await expect.poll(look, { message: 'it is drawn', intervals: [200], timeout: 90_000 }).toBeGreaterThan(2);
  return last;
}

// For people to look at, in a folder beside the failures.
export async function keepPicture(page: Page, info: TestInfo, name: string): Promise<void> {
  const folder = join(info.project.outputDir, 'pictures');
  mkdirSync(folder, { recursive: true });
  await page.screenshot({ path: join(folder, `${name}.png`), fullPage: true });
}
