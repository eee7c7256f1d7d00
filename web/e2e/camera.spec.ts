// The camera that is not to be had: refused by the person, by another program, or not there.
import { expectAccessible } from './accessible.ts';
import { partsOf } from './page.ts';
import { test, expect } from './served.ts';

const troubles = [
  ['refused', 'NotAllowedError', 'The browser may not use the camera. Allow it for this page, or choose a photo.'],
  ['in use', 'NotReadableError', 'Another program has the camera. Close that, or choose a photo.'],
  ['missing', 'NotFoundError', 'There is no camera here. Choose a photo instead.'],
  ['kept from the page', '', 'There is no camera here. Choose a photo instead.'],
] as const;

for (const [name, error, sentence] of troubles) {
  test(`the camera is ${name}`, async ({ page }, info) => {
    // As the browser answers then; the one of the tests has a camera that is always allowed.
    await page.addInitScript((kind) => {
      if (kind === '') Object.defineProperty(navigator, 'mediaDevices', { value: undefined });
      else navigator.mediaDevices.getUserMedia = () => Promise.reject(new DOMException('', kind));
    }, error);
    await page.goto('/');
    await page.getByRole('button', { name: 'Use the camera' }).click();
    const dialog = page.getByRole('dialog', { name: 'Take a photo' });
    await expect(dialog.getByRole('alert')).toHaveText(sentence);
    await expect(dialog.getByRole('button', { name: 'Take the photo' })).toBeHidden();
    await expect(dialog.locator('video')).toHaveCount(0);
    if (name === 'refused') await expectAccessible(page, info, 'camera-refused');
    await dialog.getByRole('button', { name: 'Close' }).click();
    await expect(dialog).toBeHidden();
    // And a photo is still taken otherwise.
    await expect(page.getByRole('button', { name: 'Choose a photo' })).toBeEnabled();
    await expect(partsOf(page).history).toBeHidden();
  });
}
