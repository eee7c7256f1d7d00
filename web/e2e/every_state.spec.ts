// Each state of the page, for all who use it.
import { expectAccessible } from './accessible.ts';
import { carry, drop, dropTooLarge, openEstimate, partsOf } from './page.ts';
import { nobody, pictureOf, twice } from './pictures.ts';
import { test, expect } from './served.ts';
import {
  estimateOf,
  forget,
  postInsertion,
  postPhoto,
  samplePhoto,
  startServer,
  stopServer,
  whileHeld,
} from './server.ts';

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

test('an estimate on its way', async ({ page, server }, info) => {
  await page.goto('/');
  await page.getByRole('button', { name: 'Grace Hopper, US Navy' }).click();
  // Caught at the next frame, because a fast machine is done within a second.
  const stages = /^(Looking|Measuring|Separating|Solving)/;
  await page.waitForFunction(
    (pattern) => new RegExp(pattern).test(document.querySelector('[role=status]')?.textContent ?? ''),
    stages.source,
  );
  await whileHeld(server, async () => {
    await expect(page.getByRole('status')).toHaveText(stages);
    await expect(partsOf(page).estimating).toHaveAttribute('value', /^0\.\d+$/);
    await expectAccessible(page, info, 'estimating');
    await expect(partsOf(page).estimating).toBeVisible();
  });
});

test('a photo that is carried over the page', async ({ page, oneFace }, info) => {
  const photo = { name: 'grace.jpg', mimeType: 'image/jpeg', buffer: samplePhoto('grace_hopper.jpg') };
  await page.goto('/');
  await carry(page, photo);
  await expect(page.locator('.session[data-dragging=true] .drop')).toBeVisible();
  await expectAccessible(page, info, 'carried');
  await openEstimate(page, oneFace.id);
  await carry(page, photo);
  await expect(page.locator('.session[data-dragging=true]')).toBeVisible();
  await expectAccessible(page, info, 'carried-over-estimate');
  // And away again.
  await page.locator('body').dispatchEvent('dragleave');
  await expect(page.locator('.session[data-dragging=false]')).toBeVisible();
});

test('a file that is too large', async ({ page, oneFace }, info) => {
  await page.goto('/');
  await expect(page.getByRole('button', { name: 'Grace Hopper, US Navy' })).toBeVisible();
  const sentence = page.getByRole('alert').filter({ hasText: '68 MB' });
  await dropTooLarge(page);
  await expect(sentence).toBeVisible();
  await expectAccessible(page, info, 'too-large');
  await openEstimate(page, oneFace.id);
  await dropTooLarge(page);
  await expect(sentence).toBeVisible();
  await expectAccessible(page, info, 'too-large-over-estimate');
});

test('an estimate that is gone', async ({ page }, info) => {
  await page.goto('/?estimate=0123456789abcdef');
  await expect(partsOf(page).chooseAnother).toBeVisible();
  await expectAccessible(page, info, 'gone');
});

test.describe('without its server', () => {
  test.use({ expectedComplaints: /Failed to load resource: net::ERR_/ });

  test('a page says so', async ({ page }, info) => {
    const server = await startServer();
    try {
      const { id } = await estimateOf(server, samplePhoto('grace_hopper.jpg'), 'Grace.jpg');
      await page.goto(`${server.address}?estimate=${id}`);
      await expect(partsOf(page).render).toBeEnabled();
      await stopServer(server);
      await partsOf(page).render.click();
      const sentence = page.getByRole('alert').filter({ hasText: 'Faceprobe does not answer' });
      await expect(sentence).toBeVisible();
      await expectAccessible(page, info, 'server-gone');
      await page.getByRole('button', { name: 'New photo' }).click();
      await page.getByRole('button', { name: 'Grace Hopper, US Navy' }).click();
      await expect(sentence).toBeVisible();
      await expectAccessible(page, info, 'server-gone-start');
    } finally {
      await stopServer(server);
    }
  });
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
  await page.getByRole('checkbox', { name: 'Face mesh' }).check();
  await page.getByRole('checkbox', { name: 'Confidence' }).check();
  await page.getByText('All files').click();
  await expectAccessible(page, info, 'one-face');
});

test('two faces and their room', async ({ page, twoFaces }, info) => {
  await openEstimate(page, twoFaces.id);
  await expect(page.getByRole('region', { name: 'Room' })).toBeVisible();
  await expectAccessible(page, info, 'two-faces');
});

test('all faces together', async ({ page, twoFaces }, info) => {
  await openEstimate(page, twoFaces.id);
  await page.getByRole('radio', { name: 'All faces together' }).check();
  await expect(page.getByText('Layers belong to one face')).toBeVisible();
  await expectAccessible(page, info, 'joint-light');
});

test('lamps in the room', async ({ page, server }, info) => {
  await page.goto('/');
  const { id } = await estimateOf(server, await pictureOf(page, twice), 'Twice.png');
  await openEstimate(page, id);
  await expect(page.getByRole('table', { name: 'Lamps' })).toBeVisible();
  await expectAccessible(page, info, 'lamps');
});

test('rendered without 3D', async ({ page, oneFace }, info) => {
  await openEstimate(page, oneFace.id);
  await partsOf(page).render.click();
  await expect(partsOf(page).rendered).toHaveJSProperty('complete', true);
  await page.getByText('Rendered files').click();
  await expect(page.getByRole('link', { name: 'composite.png' })).toBeVisible();
  await expectAccessible(page, info, 'rendered-without-3d');
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
