// The light: its panorama and its numbers.
import { expectMap, openEstimate, partsOf, pixelsOf } from './page.ts';
import { pictureOf, redFromTheRight } from './pictures.ts';
import { test, expect } from './served.ts';
import { get, type Estimate } from './server.ts';

const width = 512;
const height = 256;

// The mean of a channel over some of the panorama.
function meanOf(rgba: Uint8Array, channel: number, wanted: (x: number, y: number) => boolean): number {
  let sum = 0;
  let count = 0;
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      if (!wanted(x, y)) continue;
      sum += rgba[4 * (y * width + x) + channel]!;
      ++count;
    }
  }
  return sum / count;
}

test('exposure brightens the panorama, confidence hatches what was not seen', async ({ page, oneFace }) => {
  await openEstimate(page, oneFace.id);
  const everywhere = () => true;
  const exposure = page.getByRole('slider', { name: 'Exposure' });
  const was = meanOf(await pixelsOf(page), 1, everywhere);
  await exposure.focus();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowRight');
  await expect.poll(async () => meanOf(await pixelsOf(page), 1, everywhere)).toBeGreaterThan(1.2 * was);
  await page.keyboard.press('Home');
  await expect(exposure).toHaveAttribute('aria-valuetext', /^−6\sstops$/);
  await expect.poll(async () => meanOf(await pixelsOf(page), 1, everywhere)).toBeLessThan(0.5 * was);

  await page.getByRole('checkbox', { name: 'Confidence' }).check();
  await expect(page.getByText('Hatched: what the face did not see')).toBeVisible();
  const doubt = page.locator('.panorama-frame canvas').nth(1);
  await expect(doubt).toBeVisible();
  const hatching = await pixelsOf(page, doubt);
  // A face sees what is behind the photographer, in the middle, and not what is behind itself.
  const middle = meanOf(hatching, 3, (x, y) => Math.abs(x - width / 2) < 40 && Math.abs(y - height / 2) < 40);
  const behind = meanOf(hatching, 3, (x, y) => (x < 40 || x >= width - 40) && Math.abs(y - height / 2) < 40);
  expect(behind).toBeGreaterThan(middle + 20);
});

test("the table has the report's main lights", async ({ page, oneFace }) => {
  await openEstimate(page, oneFace.id);
  const lights = oneFace.report.faces[0]!.light.main_lights;
  const rows = page.getByRole('table', { name: 'Main lights' }).locator('tbody tr');
  await expect(rows).toHaveCount(lights.length);
  const angle = (value: number) => `${Math.round(value)}°`.replace('-', '−');
  for (const [index, light] of lights.entries()) {
    const row = rows.nth(index);
    await expect(row).toContainText(`azimuth ${angle(light.azimuth_deg)}, elevation ${angle(light.elevation_deg)}`);
    await expect(row.getByRole('cell').nth(2)).toHaveText(light.irradiance.toFixed(2));
    await expect(row.getByRole('cell').nth(3)).toHaveText(new RegExp(`^${Math.round(100 * light.share_of_energy)}\\s%$`));
  }
});

test('a red lamp at the right of the photo is left of the centre of the panorama', async ({ page, server }) => {
  await page.goto('/');
  const buffer = await pictureOf(page, redFromTheRight);
  await partsOf(page).photoFile.setInputFiles({ name: 'red.png', mimeType: 'image/png', buffer });
  await expectMap(page);
  const id = new URL(page.url()).searchParams.get('estimate');
  const [main] = (await get<Estimate>(server, `/estimates/${id}`)).report.faces[0]!.light.main_lights;
  expect(main!.azimuth_deg).toBeGreaterThan(10);

  const first = page.getByRole('table', { name: 'Main lights' }).locator('tbody tr').first();
  await expect(first).toContainText(/right/i);
  await expect(first).toContainText('very warm');
  const map = (await partsOf(page).panorama.boundingBox())!;
  const marker = (await page.locator('.marker').first().boundingBox())!;
  const middle = map.x + map.width / 2;
  expect(marker.x + marker.width).toBeLessThan(middle);
  // Azimuth 90 degrees is a quarter of the width away; a pixel for the browser's rounding.
  expect(Math.abs(middle - (marker.x + marker.width / 2) - (main!.azimuth_deg / 360) * map.width)).toBeLessThan(1);
  const rgba = await pixelsOf(page);
  const left = meanOf(rgba, 0, (x, y) => x < width / 2 && y > 64 && y < 192);
  const right = meanOf(rgba, 0, (x, y) => x >= width / 2 && y > 64 && y < 192);
  expect(left).toBeGreaterThan(1.2 * right);
  expect(left).toBeGreaterThan(1.5 * meanOf(rgba, 2, (x, y) => x < width / 2 && y > 64 && y < 192));
});
