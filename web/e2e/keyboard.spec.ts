// From the start page to a rendered picture without a pointer.
import type { Locator, Page } from '@playwright/test';

import { partsOf } from './page.ts';
import { test, expect } from './served.ts';

// Tab until `wanted` has the focus, which is to be seen at every stop.
async function tabTo(page: Page, wanted: Locator): Promise<void> {
  await wanted.waitFor({ state: 'attached' });
  for (let stops = 0; stops < 40; ++stops) {
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

test('the whole way by keyboard', async ({ page }) => {
  await page.goto('/');
  const parts = partsOf(page);
  await tabTo(page, page.getByRole('button', { name: 'Grace Hopper, US Navy' }));
  await page.keyboard.press('Enter');
  await expect(parts.photoName).toHaveText('Grace Hopper, US Navy');
  await expect(parts.photoName).toBeFocused();
  await expect(parts.render).toBeEnabled();

  await tabTo(page, parts.thing);
  for (const key of ['Shift+ArrowLeft', 'ArrowUp', '+', ']']) await page.keyboard.press(key);
  await tabTo(page, page.getByRole('combobox', { name: 'Material' }));
  await page.keyboard.type('Gold');
  await tabTo(page, page.getByRole('slider', { name: 'Turn' }));
  await page.keyboard.press('ArrowRight');

  await tabTo(page, parts.render);
  const asked = page.waitForRequest((request) => request.method() === 'POST');
  await page.keyboard.press('Enter');
  const request = (await asked).postDataJSON();
  expect(request).toMatchObject({ object: 'pot', material: 'gold', turn_deg: 6, face: 0, quality: 'preview' });
  // To the left, up and nearer, as the keys have said.
  const id = new URL(page.url()).searchParams.get('estimate');
  const { spot } = (await (await page.request.get(`/api/v1/estimates/${id}`)).json()) as {
    spot: { at_px: [number, number]; distance_m: number };
  };
  expect(request.at_px[0]).toBeLessThan(spot.at_px[0]);
  expect(request.at_px[1]).toBeLessThan(spot.at_px[1]);
  expect(request.distance_m).toBeLessThan(spot.distance_m);
  await expect(parts.rendered).toBeVisible();
  await expect(parts.rendered).toHaveJSProperty('naturalWidth', 512);
  // On to what has just appeared below.
  await tabTo(page, page.getByText('Rendered files'));
  await page.keyboard.press('Enter');
  await expect(page.getByRole('link', { name: 'composite.png' })).toBeVisible();
});
