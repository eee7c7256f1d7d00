// Files of an estimate: all in one, and one by one.
import { readFileSync } from 'node:fs';

import { openEstimate } from './page.ts';
import { test, expect } from './served.ts';

// Names and sizes in a ZIP's directory (APPNOTE 4.3.12, 4.3.16).
function listed(zip: Buffer): { path: string; bytes: number }[] {
  const end = zip.length - 22; // no comment
  expect(zip.readUInt32LE(0), 'magic').toBe(0x04034b50);
  expect(zip.readUInt32LE(end), 'end record').toBe(0x06054b50);
  const files = [];
  let at = zip.readUInt32LE(end + 16);
  for (let left = zip.readUInt16LE(end + 10); left > 0; --left) {
    expect(zip.readUInt32LE(at), 'entry').toBe(0x02014b50);
    const name = zip.readUInt16LE(at + 28);
    files.push({ path: zip.toString('utf8', at + 46, at + 46 + name), bytes: zip.readUInt32LE(at + 24) });
    at += 46 + name + zip.readUInt16LE(at + 30) + zip.readUInt16LE(at + 32);
  }
  return files;
}

test('the ZIP has every file that is listed', async ({ page, oneFace }) => {
  await openEstimate(page, oneFace.id);
  const downloads = page.getByRole('region', { name: 'Downloads' });
  const download = page.waitForEvent('download');
  await downloads.getByRole('link', { name: 'Everything, ZIP' }).click();
  expect((await download).suggestedFilename()).toBe('Grace.zip');
  const inZip = listed(readFileSync(await (await download).path()));
  const byPath = (a: { path: string }, b: { path: string }) => (a.path < b.path ? -1 : 1);
  // In a folder, so that unpacking does not strew them about.
  const wanted = oneFace.files.map(({ path, bytes }) => ({ path: `faceprobe/${path}`, bytes }));
  expect(inZip.sort(byPath)).toEqual(wanted.sort(byPath));

  await downloads.getByText('All files').click();
  await expect(downloads.locator('details a')).toHaveText(oneFace.files.map(({ path }) => path));

  const report = page.waitForEvent('download');
  await downloads.getByRole('link', { name: 'Report, JSON' }).click();
  expect((await report).suggestedFilename()).toBe('Grace-report.json');
  const json = JSON.parse(readFileSync(await (await report).path(), 'utf8'));
  expect(json.faces[0].light.main_lights).toEqual(oneFace.report.faces[0]!.light.main_lights);
});

const beginnings = {
  'Light map, EXR': ['environment.exr', '\x76\x2f\x31\x01'],
  'Light map, HDR': ['environment.hdr', '#?RADIANCE\n'],
  'Light map, PNG': ['environment.png', '\x89PNG\r\n\x1a\n'],
  'Blender script': ['blender.py', '# Light of a portrait'],
  'USD scene': ['light.usda', '#usda 1.0\n'],
  'glTF scene': ['light.gltf', '{'],
} as const;

test('each file that is offered by name is what its name says', async ({ page, oneFace }) => {
  await openEstimate(page, oneFace.id);
  const downloads = page.getByRole('region', { name: 'Downloads' });
  for (const [text, [path, beginning]] of Object.entries(beginnings)) {
    const download = page.waitForEvent('download');
    await downloads.getByRole('link', { name: text }).click();
    expect((await download).suggestedFilename(), text).toBe(`Grace-${path}`);
    const bytes = readFileSync(await (await download).path());
    expect(bytes.toString('latin1', 0, beginning.length), text).toBe(beginning);
    expect(bytes.length, text).toBe(oneFace.files.find((file) => file.path === path)!.bytes);
    if (path === 'light.gltf') expect(JSON.parse(bytes.toString('utf8')).asset.version).toBe('2.0');
  }
});
