// The ways in for a photo: each ends at its light.
import { drop, expectMap, partsOf } from './page.ts';
import { test, expect } from './served.ts';
import { samplePath, samplePhoto } from './server.ts';

test('a photo that is dropped', async ({ page }) => {
  await page.goto('/');
  await expect(page.getByRole('heading', { name: 'Drop a photo of a face' })).toBeVisible();
  const grace = samplePhoto('grace_hopper.jpg');
  const packed: string[] = [];
  page.on('response', (response) => response.headers()['content-encoding'] && packed.push(response.url()));
  const begin = Date.now();
  await drop(page, { name: 'grace hopper.jpg', mimeType: 'image/jpeg', buffer: grace });
  await expect(partsOf(page).estimating).toBeVisible();
  await expectMap(page);
  console.log(`From the drop to the map: ${((Date.now() - begin) / 1000).toFixed(1)} s.`);
  expect(packed, 'to pack an answer takes longer than to send it on the same machine').toEqual([]);
  await expect(partsOf(page).photoName).toHaveText('grace hopper.jpg');
  await expect(partsOf(page).photo).toHaveJSProperty('naturalWidth', 512);
  await expect(page).toHaveTitle('grace hopper.jpg – Faceprobe');
});

test('a photo that is chosen with the button', async ({ page }) => {
  await page.goto('/');
  const chooser = page.waitForEvent('filechooser');
  await page.getByRole('button', { name: 'Choose a photo' }).click();
  await (await chooser).setFiles(samplePath('astronaut.png'));
  await expectMap(page);
  await expect(partsOf(page).photoName).toHaveText('astronaut.png');
});

test('a photo that is pasted, also beside another one', async ({ page, oneFace }) => {
  await page.goto(`/?estimate=${oneFace.id}`);
  await page.evaluate(async () => {
    const photo = await (await fetch('/api/v1/samples/astronaut')).blob();
    const clipboardData = new DataTransfer();
    clipboardData.items.add(new File([photo], 'image.png', { type: 'image/png' }));
    document.dispatchEvent(new ClipboardEvent('paste', { clipboardData, bubbles: true, cancelable: true }));
  });
  await expect(partsOf(page).photoName).toHaveText('Pasted photo');
  await expectMap(page);
});

test('a sample', async ({ page }) => {
  await page.goto('/');
  await page.getByRole('button', { name: 'Eileen Collins, NASA' }).click();
  await expectMap(page);
  await expect(partsOf(page).photoName).toHaveText('Eileen Collins, NASA');
});

test('the camera, which shows a test picture without a face', async ({ page }) => {
  await page.goto('/');
  await page.getByRole('button', { name: 'Use the camera' }).click();
  const dialog = page.getByRole('dialog', { name: 'Take a photo' });
  await dialog.getByRole('button', { name: 'Close' }).click();
  await expect(dialog).toBeHidden();
  await page.getByRole('button', { name: 'Use the camera' }).click();
  await dialog.getByRole('button', { name: 'Take the photo' }).click();
  await expect(partsOf(page).photoName).toHaveText('Camera photo');
  await expect(page.getByRole('alert').filter({ hasText: 'No face was found' })).toBeVisible();
});
