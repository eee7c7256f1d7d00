// All that people do, without a pointer.
import { expectMap, openEstimate, partsOf, tabTo } from './page.ts';
import { test, expect } from './served.ts';
import { postPhoto, samplePath, samplePhoto } from './server.ts';

test('the whole way by keyboard', async ({ page }) => {
  await page.goto('/');
  const parts = partsOf(page);
  await tabTo(page, page.getByRole('button', { name: 'Grace Hopper, US Navy' }));
  await page.keyboard.press('Enter');
  await expect(parts.photoName).toHaveText('Grace Hopper, US Navy');
  await expect(parts.photoName).toBeFocused();
  await expect(parts.render).toBeEnabled();

  await tabTo(page, parts.thing);
  for (const key of ['Shift+ArrowLeft', 'ArrowUp', '+', ']']) await page.keyboard.press(key);
  await tabTo(page, page.getByRole('combobox', { name: 'Material' }));
  await page.keyboard.type('Gold');
  await tabTo(page, page.getByRole('slider', { name: 'Turn' }));
  await page.keyboard.press('ArrowRight');

  await tabTo(page, parts.render);
  const asked = page.waitForRequest((request) => request.method() === 'POST');
  await page.keyboard.press('Enter');
  const request = (await asked).postDataJSON();
  expect(request).toMatchObject({ object: 'pot', material: 'gold', turn_deg: 6, face: 0, quality: 'preview' });
  // To the left, up and nearer, as the keys have said.
  const id = new URL(page.url()).searchParams.get('estimate');
  const { spot } = (await (await page.request.get(`/api/v1/estimates/${id}`)).json()) as {
    spot: { at_px: [number, number]; distance_m: number };
  };
  expect(request.at_px[0]).toBeLessThan(spot.at_px[0]);
  expect(request.at_px[1]).toBeLessThan(spot.at_px[1]);
  expect(request.distance_m).toBeLessThan(spot.distance_m);
  await expect(parts.rendered).toBeVisible();
  await expect(parts.rendered).toHaveJSProperty('naturalWidth', 512);
  // On to what has just appeared below.
  await tabTo(page, page.getByText('Rendered files'));
  await page.keyboard.press('Enter');
  await expect(page.getByRole('link', { name: 'composite.png' })).toBeVisible();
});

test('a file is chosen by keyboard', async ({ page }) => {
  await page.goto('/');
  await tabTo(page, page.getByRole('button', { name: 'Choose a photo' }));
  const chooser = page.waitForEvent('filechooser');
  await page.keyboard.press('Space');
  await (await chooser).setFiles(samplePath('astronaut.png'));
  await expectMap(page);
  await expect(partsOf(page).photoName).toBeFocused();
});

test('the camera is opened and left by keyboard', async ({ page }) => {
  await page.goto('/');
  const button = page.getByRole('button', { name: 'Use the camera' });
  await tabTo(page, button);
  await page.keyboard.press('Enter');
  const dialog = page.getByRole('dialog', { name: 'Take a photo' });
  await expect(dialog.getByRole('button', { name: 'Take the photo' })).toBeEnabled();
  // Nothing behind the dialog takes the focus.
  for (let stops = 0; stops < 6; ++stops) {
    await page.keyboard.press('Tab');
    const within = await page.evaluate(() => {
      const at = document.activeElement!;
      return at === document.body || at.closest('dialog') !== null; // or in the browser's own buttons
    });
    expect(within).toBe(true);
  }
  await page.keyboard.press('Escape');
  await expect(dialog).toBeHidden();
  await expect(button).toBeFocused();
});

test('a face is chosen by keyboard', async ({ page, twoFaces }) => {
  await openEstimate(page, twoFaces.id);
  const boxes = page.getByRole('group', { name: 'Faces in the photo' });
  for (const [face, key] of [
    [1, 'Enter'],
    [2, 'Space'],
  ] as const) {
    const box = boxes.getByRole('button', { name: `Face ${face} of 2` });
    await tabTo(page, box);
    await page.keyboard.press(key);
    await expect(box).toHaveAttribute('aria-pressed', 'true');
    await expect(box).toBeFocused();
    await expect(page.getByRole('radio', { name: `Face ${face}` })).toBeChecked();
  }
  // From the radio buttons it is chosen by arrows.
  await tabTo(page, page.getByRole('radio', { name: 'Face 2' }));
  await page.keyboard.press('ArrowDown');
  await expect(page.getByRole('radio', { name: 'All faces together' })).toBeChecked();
});

test('a photo is come back to, and removed, by keyboard', async ({ page, server, oneFace }) => {
  await postPhoto(server, samplePhoto('astronaut.png'), 'Second.png');
  await page.goto('/');
  const { history, photoName } = partsOf(page);
  const second = history.getByRole('button', { name: 'Second.png 1 face' });
  await openEstimate(page, oneFace.id);
  await tabTo(page, history.getByRole('button', { name: /^Second\.png/ }));
  await page.keyboard.press('Enter');
  await expect(photoName).toHaveText('Second.png');
  await expectMap(page);
  await expect(second).toBeVisible();
  await tabTo(page, history.getByRole('button', { name: 'Remove Second.png' }));
  await page.keyboard.press('Enter');
  await expect(second).toBeHidden();
  await expect(page.getByRole('heading', { name: 'Drop a photo of a face' })).toBeVisible();
});
