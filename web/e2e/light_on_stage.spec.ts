// The light on the thing in the photo: bright on the side of the face's lamp, its shadow on the other, and the other way round in a mirror.
import { partsOf, steady } from './page.ts';
import { decoded, faceLitFromTheRight, pictureOf, type Pixels } from './pictures.ts';
import { test, expect } from './served.ts';
import { estimateOf, type Estimate } from './server.ts';

test.slow(); // without a graphics card the preview takes its time

type Wanted = (right: number, down: number) => boolean; // from the sphere's middle, in its radii

// Over the places wanted, mean of the sum of red, green and blue.
function brightness(pixels: Pixels, { spot, focal_px, photo }: Estimate, wanted: Wanted): number {
  const scale = pixels.width / photo.width_px;
  const radius = ((scale * spot.height_m) / 2 / spot.distance_m) * focal_px;
  const [x0, y0] = [scale * spot.at_px[0], scale * spot.at_px[1] - radius];
  let sum = 0;
  let count = 0;
  for (let y = 0; y < pixels.height; ++y) {
    for (let x = 0; x < pixels.width; ++x) {
      if (!wanted((x + 0.5 - x0) / radius, (y + 0.5 - y0) / radius)) continue;
      for (let c = 0; c < 3; ++c) sum += pixels.rgba[4 * (y * pixels.width + x) + c]!;
      ++count;
    }
  }
  expect(count, 'pixels there').toBeGreaterThan(100);
  return sum / count;
}

// `side` of the lamp: 1 right, -1 left.
function expectLitFrom(side: number, shown: Pixels, empty: Pixels, estimate: Estimate, who: string): void {
  const onSphere = (sign: number): Wanted => (right, down) => Math.hypot(right, down) < 0.9 && right * sign > 0;
  const litOverDark = brightness(shown, estimate, onSphere(side)) / brightness(shown, estimate, onSphere(-side));
  expect(litOverDark, `${who}: the sphere's side of the lamp over the other`).toBeGreaterThan(1.1);

  // Beside the sphere, as far as the photo goes on both of its sides.
  const onGround = (sign: number): Wanted => (right, down) => {
    const away = right * sign;
    return away > 1.2 && away < 1.8 && down > 0 && down < 1;
  };
  const taken = (sign: number) =>
    1 - brightness(shown, estimate, onGround(sign)) / brightness(empty, estimate, onGround(sign));
  expect(taken(-side), `${who}: what the shadow takes`).toBeGreaterThan(0.03);
  expect(taken(-side), `${who}: and more than is taken on the lamp's side`).toBeGreaterThan(1.5 * taken(side));
}

for (const [name, mirrored, side] of [
  ['a lamp at the right', false, 1],
  ['the same photo mirrored', true, -1],
] as const) {
  test(`the preview and the path tracer: ${name}`, async ({ page, server }) => {
    await page.goto('/');
    const photo = await pictureOf(page, faceLitFromTheRight, mirrored);
    const estimate = await estimateOf(server, photo, 'lit.png');
    const [main] = estimate.report.faces[0]!.light.main_lights;
    expect(side * main!.azimuth_deg, "the estimate's main light").toBeGreaterThan(20);
    expect(main!.elevation_deg, 'above the ground').toBeGreaterThan(0);

    await page.goto(`/?estimate=${estimate.id}`);
    const parts = partsOf(page);
    await expect(parts.readyStage).toBeVisible();
    await parts.facesShown.uncheck();
    await page.getByRole('combobox', { name: 'Object', exact: true }).selectOption('Sphere');
    await page.getByRole('combobox', { name: 'Material' }).selectOption('Diffuse');
    await parts.objectShown.uncheck();
    const empty = await steady(parts.frame);
    await parts.objectShown.check();
    await expect(parts.readyStage).toBeVisible();
    const preview = await steady(parts.frame, empty);
    const ground = await decoded(page, empty);
    expectLitFrom(side, await decoded(page, preview), ground, estimate, 'preview');

    await parts.render.click();
    await expect(parts.rendered).toBeVisible();
    await expect(parts.rendered).toHaveJSProperty('complete', true);
    expectLitFrom(side, await decoded(page, await steady(parts.frame)), ground, estimate, 'rendered');
  });
}
