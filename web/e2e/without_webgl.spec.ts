// A browser without WebGL: an outline stands for the thing, and all else is there.
import { openEstimate, partsOf } from './page.ts';
import { test, expect } from './served.ts';

test('the outline is dragged, turned and rendered', async ({ page, oneFace }) => {
  await openEstimate(page, oneFace.id);
  const parts = partsOf(page);
  await expect(page.getByRole('alert').filter({ hasText: 'This browser has no WebGL' })).toBeVisible();
  expect(await page.locator('canvas.stage').count()).toBe(0);

  const ghost = page.locator('.ghost');
  await expect(ghost).toHaveText('pot');
  const scale = (await parts.frame.boundingBox())!.width / oneFace.photo.width_px;
  const was = (await ghost.boundingBox())!;
  const from = { x: was.x + was.width / 2, y: was.y + was.height / 2 };
  const by = { x: 120, y: -60 };
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + by.x, from.y + by.y, { steps: 4 });
  await page.mouse.up();
  const is = (await ghost.boundingBox())!;
  expect(Math.abs(is.x - was.x - by.x)).toBeLessThan(1);
  expect(Math.abs(is.y - was.y - by.y)).toBeLessThan(1);

  await page.mouse.wheel(0, 200); // farther
  await expect.poll(async () => (await ghost.boundingBox())!.height).toBeLessThan(0.9 * is.height);
  await page.getByRole('combobox', { name: 'Object', exact: true }).selectOption('Robot');
  await expect(ghost).toHaveText('robot');
  await page.getByRole('slider', { name: 'Turn' }).fill('90');

  const asked = page.waitForRequest((request) => request.method() === 'POST');
  await parts.render.click();
  const request = (await asked).postDataJSON();
  const [x, y] = oneFace.spot.at_px;
  expect(request).toMatchObject({ object: 'robot', turn_deg: 90 });
  expect(Math.abs(request.at_px[0] - x - by.x / scale)).toBeLessThan(1);
  expect(Math.abs(request.at_px[1] - y - by.y / scale)).toBeLessThan(1);
  expect(request.distance_m).toBeCloseTo(oneFace.spot.distance_m * 1.001 ** 200, 3);
  await expect(parts.rendered).toBeVisible();
  await expect(parts.rendered).toHaveJSProperty('naturalWidth', oneFace.photo.width_px);
});
