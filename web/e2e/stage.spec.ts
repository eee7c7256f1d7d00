// The thing in the photo: where the preview shows it, the path tracer puts it.
import { expectAccessible } from './accessible.ts';
import { openEstimate, partsOf, steady } from './page.ts';
import { differenceOf, sizeOfPng } from './pictures.ts';
import { test, expect } from './served.ts';
import { get, insertionOf, type Insertion } from './server.ts';
import { readFileSync } from 'node:fs';

test.slow(); // without a graphics card the preview takes its time

interface InsertReport {
  object_box_m: { min: [number, number, number]; max: [number, number, number] };
}

test('dragging moves the thing, and rendering puts it there', async ({ page, server, oneFace }, info) => {
  const { width_px: width, height_px: height } = oneFace.photo;
  const { at_px: spot, distance_m: distance } = oneFace.spot;
  await openEstimate(page, oneFace.id);
  const parts = partsOf(page);
  await expect(parts.readyStage).toBeVisible();
  await parts.facesShown.uncheck();
  await parts.objectShown.uncheck();
  const empty = await steady(parts.frame);
  await parts.objectShown.check();
  await expect(parts.readyStage).toBeVisible();
  const before = await steady(parts.frame, empty);

  const frame = (await parts.frame.boundingBox())!;
  const scale = frame.width / width;
  const from = { x: frame.x + spot[0] * scale, y: frame.y + (spot[1] - 20) * scale };
  const by = { x: 130, y: -40 };
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + by.x / 2, from.y + by.y / 2, { steps: 3 });
  await page.mouse.move(from.x + by.x, from.y + by.y, { steps: 3 });
  await page.mouse.up();
  await page.mouse.move(5, 5);
  const after = await steady(parts.frame, before);

  const was = await differenceOf(page, before, empty);
  const is = await differenceOf(page, after, empty);
  // A hundredth of the frame: perspective shows the moved thing from a little aside.
  expect(is.left - was.left).toBeCloseTo(by.x / frame.width, 1.7);
  expect(is.bottom - was.bottom).toBeCloseTo(by.y / frame.height, 1.7);

  const asked = page.waitForRequest((request) => request.method() === 'POST');
  const answered = page.waitForResponse((response) => response.request().method() === 'POST');
  await parts.render.click();
  const { at_px: at, ...rest } = (await asked).postDataJSON();
  const { id } = (await (await answered).json()) as Insertion;
  expect(Math.abs(at[0] - spot[0] - by.x / scale), 'to the right, px').toBeLessThan(1);
  expect(Math.abs(at[1] - spot[1] - by.y / scale), 'down, px').toBeLessThan(1);

  await expect(parts.rendered).toBeVisible();
  await expect(parts.rendered).toHaveJSProperty('complete', true);
  const drawn = await differenceOf(page, await steady(parts.frame, after), empty);
  for (const side of ['left', 'right', 'top', 'bottom'] as const)
    expect(Math.abs(drawn[side] - is[side]), `${side} of the thing, rendered and previewed`).toBeLessThan(0.03);

  // The same thing, rendered where it stood first: only moved, by the pixels that the pointer went.
  const first = await insertionOf(server, oneFace.id, { ...rest, at_px: spot });
  const boxOf = async (insertion: string) =>
    (await get<InsertReport>(server, `/insertions/${insertion}/files/insert.json`)).object_box_m;
  const [there, here] = [await boxOf(first.id), await boxOf(id)];
  const perPixel = distance / oneFace.focal_px;
  expect(here.min[0] - there.min[0]).toBeCloseTo((at[0] - spot[0]) * perPixel, 5);
  expect(here.min[1] - there.min[1]).toBeCloseTo((spot[1] - at[1]) * perPixel, 5);
  expect(here.min[2] - there.min[2]).toBeCloseTo(0, 5);

  await expectAccessible(page, info, 'rendered');
  await page.getByText('Rendered files').click();
  const download = page.waitForEvent('download');
  await page.getByRole('link', { name: 'composite.png' }).click();
  expect((await download).suggestedFilename()).toBe('Grace-pot-composite.png');
  expect(sizeOfPng(readFileSync(await (await download).path()))).toEqual([width, height]);

  // What is changed is to be seen, and the rendered picture does not show it.
  await page.getByRole('button', { name: 'Put it back' }).click();
  await expect(page.getByRole('radio', { name: 'Preview' })).toBeChecked();
  await expect(parts.rendered).toBeHidden();
  await expectAccessible(page, info, 'preview');
});
