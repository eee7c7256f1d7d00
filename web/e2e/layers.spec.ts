// Two layers of a face and a line between them.
import { openEstimate } from './page.ts';
import { test, expect } from './served.ts';

test('the wipe moves by keyboard and by pointer', async ({ page, oneFace }) => {
  await openEstimate(page, oneFace.id);
  const layers = page.getByRole('region', { name: 'Layers' });
  const wipe = layers.getByRole('slider', { name: 'Wipe' });
  const [right, left] = [layers.locator('img').first(), layers.locator('img.wipe-left')];
  await layers.getByRole('combobox', { name: 'Left layer' }).selectOption('Normals');
  await expect(left).toHaveAttribute('src', /\/normals\.png$/);
  await expect(left).toHaveAttribute('alt', 'Normals: which way the skin faces');
  for (const image of [left, right]) await expect(image).not.toHaveJSProperty('naturalWidth', 0);

  const shown = () => left.evaluate((image) => getComputedStyle(image).clipPath);
  await wipe.focus();
  await page.keyboard.press('Home');
  await expect.poll(shown).toBe('inset(0px 100% 0px 0px)');
  await page.keyboard.press('ArrowRight');
  await expect.poll(shown).toBe('inset(0px 99% 0px 0px)');
  await expect(wipe).toHaveAttribute('aria-valuetext', /^1\s% left layer$/);
  await page.keyboard.press('End');
  await expect.poll(shown).toBe('inset(0px 0% 0px 0px)');

  const box = (await wipe.boundingBox())!;
  await page.mouse.click(box.x + box.width / 4, box.y + box.height / 2);
  const line = (await layers.locator('.wipe-line').boundingBox())!;
  // The slider's own thumb is as wide as 20 px.
  expect(Math.abs(line.x - (box.x + box.width / 4))).toBeLessThan(12);
});
