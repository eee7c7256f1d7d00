// By finger on a small screen, and where the parts are on small and large ones.
import type { Page } from '@playwright/test';

import { keepPicture, openEstimate, partsOf } from './page.ts';
import { test, expect } from './served.ts';

// One finger down, along a line, and up again. As the browser itself gets it: Playwright's own only taps.
async function swipe(page: Page, from: { x: number; y: number }, by: { x: number; y: number }): Promise<void> {
  const device = await page.context().newCDPSession(page);
  const steps = 8;
  for (let step = 0; step <= steps; ++step) {
    const point = { x: from.x + (by.x * step) / steps, y: from.y + (by.y * step) / steps };
    const type = step === 0 ? 'touchStart' : 'touchMove';
    await device.send('Input.dispatchTouchEvent', { type, touchPoints: [point] });
  }
  await device.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await device.detach();
}

const scrolled = (page: Page) => page.evaluate(() => scrollY);

test.describe('by finger', () => {
  test.use({ viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true });

  test('the thing is dragged, and beside it the page scrolls', async ({ page, oneFace }, info) => {
    await openEstimate(page, oneFace.id);
    const { frame, thing, render } = partsOf(page);
    await frame.scrollIntoViewIfNeeded();
    const ghost = page.locator('.ghost');
    await expect(ghost).toHaveText('pot');
    const was = (await ghost.boundingBox())!;
    const before = await scrolled(page);
    const by = { x: 60, y: -40 };
    await swipe(page, { x: was.x + was.width / 2, y: was.y + was.height / 2 }, by);
    await expect.poll(async () => Math.abs((await ghost.boundingBox())!.x - was.x - by.x)).toBeLessThan(1.5);
    expect(Math.abs((await ghost.boundingBox())!.y - was.y - by.y)).toBeLessThan(1.5);
    expect(await scrolled(page), 'while the thing is held the page stays').toBe(before);
    await expect(thing).toBeFocused();
    await keepPicture(page, info, 'phone-dragged');

    const asked = page.waitForRequest((request) => request.method() === 'POST');
    await render.tap();
    const { at_px: at } = (await asked).postDataJSON() as { at_px: [number, number] };
    const scale = (await frame.boundingBox())!.width / oneFace.photo.width_px;
    expect(Math.abs(at[0] - oneFace.spot.at_px[0] - by.x / scale)).toBeLessThan(1.5 / scale);
    expect(Math.abs(at[1] - oneFace.spot.at_px[1] - by.y / scale)).toBeLessThan(1.5 / scale);
    await expect(partsOf(page).rendered).toBeVisible();

    await page.evaluate(() => scrollTo(0, 0));
    const stays = (await ghost.boundingBox())!;
    const box = (await frame.boundingBox())!;
    await swipe(page, { x: box.x + box.width - 20, y: box.y + box.height / 2 }, { x: 0, y: -150 });
    await expect.poll(() => scrolled(page)).toBeGreaterThan(50);
    const moved = (await ghost.boundingBox())!;
    expect(Math.abs(moved.x - stays.x), 'beside the thing nothing is dragged').toBeLessThan(1);
    expect(Math.abs(moved.y + (await scrolled(page)) - stays.y)).toBeLessThan(1);
  });

  test('everything in one column', async ({ page, twoFaces }, info) => {
    await openEstimate(page, twoFaces.id);
    const { columns, wide } = await layout(page);
    expect(columns).toBe(1);
    expect(wide, 'no sideways scrolling').toBe(false);
    await keepPicture(page, info, 'phone');
  });
});

test('two columns where there is room', async ({ page, twoFaces }, info) => {
  await page.setViewportSize({ width: 1280, height: 900 });
  await openEstimate(page, twoFaces.id);
  const { columns, wide } = await layout(page);
  expect(columns).toBe(2);
  expect(wide).toBe(false);
  await keepPicture(page, info, 'two-columns');
});

// How many of the page's parts are beside one another, at most.
async function layout(page: Page): Promise<{ columns: number; wide: boolean }> {
  const names = ['Picture', 'Object in the photo', 'Light', 'Layers', 'Downloads', 'Room'];
  const boxes = await Promise.all(
    names.map(async (name) => (await page.getByRole('region', { name, exact: true }).boundingBox())!),
  );
  const columns = boxes.map((box) => {
    const beside = boxes.filter((other) => other.y < box.y + box.height - 1 && box.y < other.y + other.height - 1);
    return new Set(beside.map(({ x }) => Math.round(x))).size;
  });
  const wide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
  return { columns: Math.max(...columns), wide };
}
