// Names of files are text, whatever is in them.
import { expectMap, partsOf } from './page.ts';
import { nobody, pictureOf } from './pictures.ts';
import { test, expect } from './served.ts';
import { samplePhoto } from './server.ts';

const names = [
  '<img src=x onerror=alert(1)>.jpg',
  '../../etc/passwd.png',
  `${'long '.repeat(60)}.jpg`,
  'photo\u202egnp.exe',
  `"'&quot;);alert(1)//.jpg`,
];

test('names are shown as they are, and nothing in them runs', async ({ page, kept }) => {
  await page.goto('/');
  const buffer = await pictureOf(page, nobody);
  for (const name of names) {
    await partsOf(page).photoFile.setInputFiles({ name, mimeType: 'image/png', buffer });
    await expect(partsOf(page).chooseAnother).toBeVisible();
    const shown = (await partsOf(page).photoName.textContent())!;
    expect(shown.length).toBeGreaterThan(10);
    expect(name.startsWith(shown), `${shown} for ${name}`).toBe(true);
    if (name.length < 200) expect(shown).toBe(name);
    await expect(page).toHaveTitle(new RegExp('– Faceprobe$'));
    await partsOf(page).chooseAnother.click();
  }
  const { history } = partsOf(page);
  await expect(history.getByRole('button', { name: /^Remove/ })).toHaveCount(names.length + kept.size);
  for (const name of names) await expect(history.getByText(name.slice(0, 100).trim())).toBeVisible();
  expect(await page.locator('img[src=x]').count()).toBe(0);
  expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth)).toBe(true);
});

test('a name with folders downloads into none', async ({ page }) => {
  await page.goto('/');
  const buffer = samplePhoto('grace_hopper.jpg');
  await partsOf(page).photoFile.setInputFiles({ name: '../../etc/passwd.<b>.png', mimeType: 'image/png', buffer });
  await expectMap(page);
  const download = page.waitForEvent('download');
  await page.getByRole('link', { name: 'Everything, ZIP' }).click();
  expect((await download).suggestedFilename()).toMatch(/^passwd\.[^/\\<>]+\.zip$/);
  await (await download).delete();
});
