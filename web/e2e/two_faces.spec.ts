// Several faces: each has its light, all have one together, and lamps have places.
import { readFileSync } from 'node:fs';

import { openEstimate, partsOf, pixelsOf } from './page.ts';
import { test, expect } from './served.ts';

test('faces are chosen in the photo or beside the light', async ({ page, twoFaces }) => {
  await openEstimate(page, twoFaces.id);
  const parts = partsOf(page);
  const boxes = page.getByRole('group', { name: 'Faces in the photo' });
  const seenBy = page.getByRole('group', { name: 'Seen by' });
  const azimuth = (lights: { azimuth_deg: number }[]) => `azimuth ${Math.round(lights[0]!.azimuth_deg)}°`.replace('-', '−');
  const first = parts.light.getByRole('table', { name: 'Main lights' }).locator('tbody tr').first();

  for (const face of [1, 2]) {
    const box = boxes.getByRole('button', { name: `Face ${face} of 2` });
    await box.click({ position: { x: 6, y: 40 } });
    await expect(box).toHaveAttribute('aria-pressed', 'true');
    await expect(seenBy.getByRole('radio', { name: `Face ${face}` })).toBeChecked();
    await expect(first).toContainText(azimuth(twoFaces.report.faces[face - 1]!.light.main_lights));
  }
  const ofTheSecond = await pixelsOf(page);
  await seenBy.getByRole('radio', { name: 'All faces together' }).check();
  await expect(first).toContainText(azimuth(twoFaces.report.joint_light!.main_lights));
  await expect.poll(async () => Buffer.compare(await pixelsOf(page), ofTheSecond)).not.toBe(0);
  await expect(page.getByRole('region', { name: 'Layers' })).toContainText('Layers belong to one face');
  await expect(boxes.locator('[aria-pressed=true]')).toHaveCount(0);

  const asked = page.waitForRequest((request) => request.method() === 'POST');
  await parts.render.click();
  expect((await asked).postDataJSON()).toMatchObject({ joint_light: true, quality: 'preview' });
  await expect(parts.rendered).toBeVisible();

  await page.getByRole('checkbox', { name: 'Mesh points' }).check();
  await expect(page.getByRole('img', { name: 'Points of the face meshes' }).locator('path')).toHaveCount(2);
});

test('the room is shown, and downloads as glTF', async ({ page, twoFaces }) => {
  await openEstimate(page, twoFaces.id);
  const room = page.getByRole('region', { name: 'Room' });
  await expect(room.getByRole('img')).not.toHaveJSProperty('naturalWidth', 0);
  const file = await page.request.get(`/api/v1/estimates/${twoFaces.id}/files/room.json`);
  const { lamps } = (await file.json()) as { lamps: unknown[] };
  await expect(room.locator('tbody tr')).toHaveCount(lamps.length);
  const download = page.waitForEvent('download');
  await page.getByRole('link', { name: 'Room, glTF' }).click();
  expect((await download).suggestedFilename()).toBe('Two-room.gltf');
  const gltf = JSON.parse(readFileSync(await (await download).path(), 'utf8'));
  expect(gltf.asset.version).toBe('2.0');
  expect(gltf.nodes.length).toBeGreaterThanOrEqual(3); // the camera and two faces
});
