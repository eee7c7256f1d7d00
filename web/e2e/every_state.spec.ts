// Each state of the page, for all who use it.
import { expectAccessible } from './accessible.ts';
import { drop, openEstimate, partsOf } from './page.ts';
import { nobody, pictureOf } from './pictures.ts';
import { test, expect } from './served.ts';
import { forget, postInsertion, postPhoto, samplePhoto, whileHeld } from './server.ts';

test('before a photo', async ({ page }, info) => {
  await page.goto('/');
  await expect(page.getByRole('button', { name: 'Grace Hopper, US Navy' })).toBeVisible();
  await expectAccessible(page, info, 'start');
});

test('the camera', async ({ page }, info) => {
  await page.goto('/');
  await page.getByRole('button', { name: 'Use the camera' }).click();
  await expect(page.getByRole('button', { name: 'Take the photo' })).toBeEnabled();
  await expectAccessible(page, info, 'camera');
});

test('at work', async ({ page, server, oneFace }, info) => {
  const slow = await postInsertion(server, oneFace.id, { object: 'robot', quality: 'final' });
  const { id } = await postPhoto(server, samplePhoto('astronaut.png'), 'Waiting.png');
  await page.goto(`/?estimate=${id}`);
  const waits = () => expect(page.getByRole('status')).toHaveText('Waiting for its turn');
  await waits();
  await whileHeld(server, async () => {
    await expectAccessible(page, info, 'waiting');
    await waits();
  });
  await forget(server, `/insertions/${slow.id}`);
});

test('failures', async ({ page }, info) => {
  await page.goto('/');
  const buffer = await pictureOf(page, nobody);
  await drop(page, { name: 'A wall that nobody stands in front of, from last summer.png', mimeType: 'image/png', buffer });
  await expect(partsOf(page).chooseAnother).toBeVisible();
  await expectAccessible(page, info, 'no-face');
});

test('a face and its light', async ({ page, oneFace }, info) => {
  await openEstimate(page, oneFace.id);
  await page.getByRole('checkbox', { name: 'Mesh points' }).check();
  await page.getByRole('checkbox', { name: 'Confidence' }).check();
  await page.getByText('All files').click();
  await expectAccessible(page, info, 'one-face');
});

test('two faces and their room', async ({ page, twoFaces }, info) => {
  await openEstimate(page, twoFaces.id);
  await expect(page.getByRole('region', { name: 'Room' })).toBeVisible();
  await expectAccessible(page, info, 'two-faces');
});

test('rendering, which can be stopped', async ({ page, server, oneFace }, info) => {
  await openEstimate(page, oneFace.id);
  const parts = partsOf(page);
  await page.getByRole('radio', { name: 'Final' }).check();
  await parts.render.click();
  await page.getByRole('button', { name: 'Cancel' }).click();
  await expect(parts.rendering).toBeHidden();
  await expect(parts.render).toBeEnabled();
  await expect(parts.rendered).toBeHidden();
  // Once more, to be looked at.
  await parts.render.click();
  await expect(page.getByRole('status').filter({ hasText: 'Drawing' })).toBeVisible();
  await whileHeld(server, async () => {
    await expectAccessible(page, info, 'rendering');
    await expect(parts.rendering).toBeVisible();
  });
});
