// Dark or light, and how much moves.
import { test, expect } from './served.ts';
import { postInsertion, postPhoto, forget, samplePhoto, whileHeld } from './server.ts';

test("the theme is the system's, until one is chosen, and then that, also after a reload", async ({ page }) => {
  const dark = page.getByRole('switch', { name: 'Dark' });
  const ground = () => page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
  await page.emulateMedia({ colorScheme: 'dark' });
  await page.goto('/');
  await expect(dark).toBeChecked();
  expect(await ground()).toBe('rgb(19, 20, 21)');
  await page.emulateMedia({ colorScheme: 'light' });
  await expect(dark).not.toBeChecked();
  expect(await ground()).toBe('rgb(242, 241, 239)');
  await dark.click();
  expect(await ground()).toBe('rgb(19, 20, 21)');
  await page.reload();
  await expect(dark).toBeChecked();
  expect(await ground()).toBe('rgb(19, 20, 21)');
});

test('nothing moves by itself for those who do not want it', async ({ page, server, oneFace }) => {
  const slow = await postInsertion(server, oneFace.id, { object: 'robot', quality: 'final' });
  const { id } = await postPhoto(server, samplePhoto('astronaut.png'), 'Waiting.png');
  const moving = () => page.evaluate(() => document.getAnimations().length);
  await page.goto(`/?estimate=${id}`);
  await expect(page.getByRole('status')).toHaveText('Waiting for its turn');
  await whileHeld(server, async () => {
    await expect.poll(moving).toBeGreaterThan(0);
    await page.emulateMedia({ reducedMotion: 'reduce' });
    await expect.poll(moving).toBe(0);
    await expect(page.getByRole('status')).toHaveText('Waiting for its turn');
  });
  await forget(server, `/insertions/${slow.id}`);
});
