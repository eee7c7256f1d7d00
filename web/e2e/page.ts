// The page's parts by the names that people hear, and what is done with them again and again.
import { expect, type JSHandle, type Locator, type Page, type TestInfo } from '@playwright/test';
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';

import { apart, clearly, decoded, type Photo, type Pixels } from './pictures.ts';

const rounding = 8; // of 255: browsers do not draw an enlarged picture alike each time

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

// As a file manager carries it over the page.
export async function carry(page: Page, photo: Photo): Promise<JSHandle<DataTransfer>> {
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
  return transfer;
}

// And drops it there.
export async function drop(page: Page, photo: Photo): Promise<void> {
  await page.locator('body').dispatchEvent('drop', { dataTransfer: await carry(page, photo) });
}

// A file above the server's limit, which is not sent; made in the page, because it would take long to get there.
export async function dropTooLarge(page: Page): Promise<void> {
  await page.evaluate(() => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([new Uint8Array(68_000_000)], 'huge.jpg', { type: 'image/jpeg' }));
    document.body.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, cancelable: true }));
  });
}

// Tab until `wanted` has the focus, which is to be seen at every stop.
export async function tabTo(page: Page, wanted: Locator): Promise<void> {
  await wanted.waitFor({ state: 'attached' });
  for (let stops = 0; stops < 80; ++stops) {
    await page.keyboard.press('Tab');
    const outlined = await page.evaluate(() => {
      const at = document.activeElement!;
      const shown = [at, ...(at.nextElementSibling ? [at.nextElementSibling] : [])];
      return at === document.body || shown.some((element) => getComputedStyle(element).outlineStyle !== 'none');
    });
    const focused = await page.evaluate(() => document.activeElement!.outerHTML.slice(0, 120));
    expect(outlined, `focus is to be seen at ${focused}`).toBe(true);
    if (await wanted.evaluate((element) => element === document.activeElement)) return;
  }
  throw new Error(`Tab does not get to ${wanted}.`);
}

// A picture of a part once it has stopped to change, for what fades in or takes its time to be drawn; if `unlike` is given, not before it is another.
export async function steady(part: Locator, unlike?: Buffer): Promise<Buffer> {
  const page = part.page();
  const before = unlike && (await decoded(page, unlike));
  let last: Pixels | undefined;
  let shot: Buffer = Buffer.alloc(0);
  let alike = 0;
  const look = async () => {
    shot = await part.screenshot();
    const now = await decoded(page, shot);
    const another = !before || apart(now, before) > clearly;
    alike = another && last && apart(now, last) < rounding ? alike + 1 : 0;
    last = now;
    return alike;
  };
  await expect.poll(look, { message: 'it is drawn', intervals: [200], timeout: 90_000 }).toBeGreaterThan(1);
  return shot;
}

// For people to look at, in a folder beside the failures.
export async function keepPicture(page: Page, info: TestInfo, name: string): Promise<void> {
  const folder = join(info.project.outputDir, 'pictures');
  mkdirSync(folder, { recursive: true });
  await page.screenshot({ path: join(folder, `${name}.png`), fullPage: true });
}
