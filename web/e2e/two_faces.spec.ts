// Several faces: each has its light, all have one together, and lamps have places.
import { readFileSync } from 'node:fs';

import { openEstimate, partsOf, pixelsOf } from './page.ts';
import { pictureOf, twice } from './pictures.ts';
import { test, expect } from './served.ts';
import { estimateOf, get } from './server.ts';

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

  await page.getByRole('checkbox', { name: 'Face mesh' }).check();
  await expect(page.getByRole('img', { name: 'Lines of the face meshes' }).locator('path')).toHaveCount(2);
});

test('the room is shown, and downloads as glTF', async ({ page, twoFaces }) => {
  await openEstimate(page, twoFaces.id);
  const room = page.getByRole('region', { name: 'Room' });
  await expect(room.getByRole('img')).not.toHaveJSProperty('naturalWidth', 0);
  const download = page.waitForEvent('download');
  await page.getByRole('link', { name: 'Room, glTF' }).click();
  expect((await download).suggestedFilename()).toBe('Two-room.gltf');
  const gltf = JSON.parse(readFileSync(await (await download).path(), 'utf8'));
  expect(gltf.asset.version).toBe('2.0');
  expect(gltf.nodes.length).toBeGreaterThanOrEqual(3); // the camera and two faces
});

interface Lamp {
  irradiance?: number;
  intensity?: number;
  seen_by: { face: number }[];
}

test('the lamps that both faces saw are in the room', async ({ page, server }) => {
  await page.goto('/');
  const { id } = await estimateOf(server, await pictureOf(page, twice), 'Twice.png');
  const { lamps } = await get<{ lamps: Lamp[] }>(server, `/estimates/${id}/files/room.json`);
  expect(lamps.length, 'one face twice has seen the same main light twice').toBeGreaterThan(0);
  await openEstimate(page, id);
  const rows = page.getByRole('region', { name: 'Room' }).getByRole('table', { name: 'Lamps' }).locator('tbody tr');
  await expect(rows).toHaveCount(lamps.length);
  for (const [index, { irradiance, intensity, seen_by: faces }] of lamps.entries()) {
    const cells = rows.nth(index).getByRole('cell');
    await expect(cells.first()).toHaveText(/\S/);
    await expect(cells.nth(2)).toHaveText((intensity ?? irradiance)!.toFixed(2));
    await expect(cells.nth(3)).toHaveText(faces.map(({ face }) => face).join(', '));
    expect(faces.length).toBeGreaterThan(1);
  }
});
