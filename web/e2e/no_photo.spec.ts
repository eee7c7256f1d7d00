// What is no photo of a face ends in a sentence beside it, and in a way on.
import { drop, dropTooLarge, partsOf } from './page.ts';
import { nobody, pictureOf } from './pictures.ts';
import { test, expect } from './served.ts';

test('a picture without a face', async ({ page }) => {
  await page.goto('/');
  const buffer = await pictureOf(page, nobody);
  await partsOf(page).photoFile.setInputFiles({ name: 'wall.png', mimeType: 'image/png', buffer });
  await expect(page.getByRole('alert').filter({ hasText: 'No face was found' })).toContainText('240 x 160 px');
  await expect(partsOf(page).photo).toHaveJSProperty('naturalWidth', 240);
  await expect(partsOf(page).history.getByRole('button', { name: 'wall.png no face' })).toBeVisible();
  await partsOf(page).chooseAnother.click();
  await expect(page.getByRole('heading', { name: 'Drop a photo of a face' })).toBeVisible();
});

test('a file that is no photo', async ({ page }) => {
  await page.goto('/');
  await drop(page, { name: 'letter.jpg', mimeType: 'image/jpeg', buffer: Buffer.from('Dear Sir or Madam') });
  const sentence = page.getByRole('alert').filter({ hasText: /./ });
  await expect(sentence).toHaveCount(1);
  await expect(sentence).toContainText('is not a picture that can be read');
  await expect(sentence).not.toContainText('/'); // the server's folders are nobody's business
  await expect(partsOf(page).photo).toBeHidden();
  await partsOf(page).chooseAnother.click();
  await expect(page.getByRole('button', { name: 'Choose a photo' })).toBeEnabled();
});

test('a file that is too large is not sent', async ({ page }) => {
  await page.goto('/');
  await expect(page.getByRole('button', { name: 'Grace Hopper, US Navy' })).toBeVisible(); // the server has told its limits
  const sent: string[] = [];
  page.on('request', (request) => request.method() === 'POST' && sent.push(request.url()));
  await dropTooLarge(page);
  await expect(page.getByRole('alert').filter({ hasText: '68 MB' })).toContainText('up to 67 MB');
  await expect(page.getByRole('button', { name: 'Choose a photo' })).toBeEnabled();
  expect(sent).toEqual([]);
});
