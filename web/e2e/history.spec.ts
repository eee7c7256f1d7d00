// The photos of this session.
import { expectMap, openEstimate, partsOf } from './page.ts';
import { test, expect } from './served.ts';

test('photos are come back to, kept over a reload, and removed', async ({ page, oneFace, twoFaces }) => {
  await openEstimate(page, oneFace.id);
  const { history, photoName } = partsOf(page);
  await expect(history.getByRole('button', { name: /faces?$/ })).toHaveCount(2);
  await history.getByRole('button', { name: 'Two.png 2 faces' }).click();
  await expect(photoName).toHaveText('Two.png');
  await expect(page).toHaveURL(`/?estimate=${twoFaces.id}`);
  await expect(history.locator('[aria-current=true]')).toContainText('Two.png');
  await page.goBack();
  await expect(photoName).toHaveText('Grace.jpg');
  await page.reload();
  await expect(photoName).toHaveText('Grace.jpg');
  await expectMap(page);

  await page.getByRole('button', { name: 'New photo' }).click();
  await expect(page).toHaveURL('/');
  await page.getByRole('button', { name: 'Eileen Collins, NASA' }).click();
  await expectMap(page);
  const entry = history.getByRole('button', { name: 'Eileen Collins, NASA 1 face' });
  await expect(entry).toBeVisible();
  await history.getByRole('button', { name: 'Remove Eileen Collins, NASA' }).click();
  await expect(entry).toBeHidden();
  // What is gone is not shown any more, and what was there is.
  await expect(page.getByRole('heading', { name: 'Drop a photo of a face' })).toBeVisible();
  await expect(history.getByRole('button', { name: 'Grace.jpg 1 face' })).toBeVisible();
});

test('an address of an estimate that is gone', async ({ page }) => {
  await page.goto('/?estimate=0123456789abcdef');
  await expect(page.getByRole('alert').filter({ hasText: /./ })).toBeVisible();
  await partsOf(page).chooseAnother.click();
  await expect(page.getByRole('heading', { name: 'Drop a photo of a face' })).toBeVisible();
});
