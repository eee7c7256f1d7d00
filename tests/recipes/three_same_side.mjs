// A white sphere where the face was, lit by three.js as docs/recipes.md says: is it bright where the report says that the lamp is?
//
//   node three_same_side.mjs FACEPROBE PHOTO FOLDER      # three_same_side.sh says what is needed
//
// The recipe's lines are run as they stand there. Vectors are in the portrait's camera frame, which is also three.js's.
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../..', import.meta.url));
const { chromium } = createRequire(join(root, 'web/package.json'))('playwright-core');
const [faceprobe, photo, work] = process.argv.slice(2);
const site = 'http://recipe.test/'; // answered here; nothing is asked of any other address
const dominant = 0.2; // share of the energy from which a main light alone says where the bright side is, as in blender_same_side.py
const types = { '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json' };
const failures = [];

function expect(holds, text) {
  console.log(holds ? 'ok    ' : 'FAILED', text);
  if (!holds) failures.push(text);
}

// The recipe: a way with the map, and one with the harmonics.
function blocks() {
  const section = readFileSync(join(root, 'docs/recipes.md'), 'utf8')
    .split(/^## /m)
    .find((text) => text.startsWith('three.js\n'));
  const found = [...(section ?? '').matchAll(/^```js\n(.*?)^```$/gms)].map(([, code]) => code);
  const names = { map: 'HDRLoader', harmonics: 'LightProbe' };
  if (found.length !== 2 || !Object.values(names).every((name, i) => found[i].includes(name)))
    throw new Error(
      'docs/recipes.md has other blocks in "three.js" than a map and a LightProbe; this test runs those two.',
    );
  return { map: found[0], harmonics: found[1] };
}

// As if the only lamp were warm and at the right of the photo; and the same from a camera that sees all mirrored.
async function pictures(page) {
  const drawn = await page.evaluate(async (base64) => {
    const portrait = await createImageBitmap(await (await fetch(`data:image/jpeg;base64,${base64}`)).blob());
    const draw = async (mirrored) => {
      const canvas = new OffscreenCanvas(portrait.width, portrait.height);
      const context = canvas.getContext('2d');
      if (mirrored) context.setTransform(-1, 0, 0, 1, portrait.width, 0);
      context.drawImage(portrait, 0, 0);
      const light = context.createLinearGradient(168, 0, 356, 0); // across the face
      light.addColorStop(0, 'rgb(38 38 38)');
      light.addColorStop(1, 'rgb(255 204 178)');
      context.globalCompositeOperation = 'multiply';
      context.fillStyle = light;
      context.fillRect(0, 0, portrait.width, portrait.height);
      let text = '';
      for (const byte of new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer()))
        text += String.fromCharCode(byte);
      return btoa(text);
    };
    return { 'lamp at the right': await draw(false), mirrored: await draw(true) };
  }, readFileSync(photo).toString('base64'));
  return Object.entries(drawn).map(([name, base64]) => [name, Buffer.from(base64, 'base64')]);
}

// In the page, around the recipe: what every scene has, the camera as the recipe says, and the sphere. Answers with its normals and radiances.
async function seenAfter(recipe) {
  const THREE = (globalThis.THREE = await import('three'));
  const scene = (globalThis.scene = new THREE.Scene());
  const renderer = (globalThis.renderer = new THREE.WebGLRenderer());
  await import(recipe);

  const { photo, camera: taken, faces, largest_face } = await (await fetch('light/report.json')).json();
  const fov = (2 * Math.atan(photo.height_px / (2 * taken.focal_px)) * 180) / Math.PI;
  const camera = new THREE.PerspectiveCamera(fov, photo.width_px / photo.height_px, 0.01, 100);
  camera.updateMatrixWorld();
  const ball = new THREE.Sphere(new THREE.Vector3(...faces[largest_face].position_m), 0.1);
  const matt = new THREE.MeshPhysicalMaterial({ roughness: 1, specularIntensity: 0 });
  const sphere = new THREE.Mesh(new THREE.SphereGeometry(ball.radius, 128, 64), matt);
  sphere.position.copy(ball.center);
  scene.add(sphere);

  const [width, height] = [photo.width_px >> 2, photo.height_px >> 2];
  const linear = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType });
  renderer.setRenderTarget(linear);
  renderer.render(scene, camera);
  const rgba = new Float32Array(4 * width * height); // rows from the bottom
  renderer.readRenderTargetPixels(linear, 0, 0, width, height, rgba);
  const caster = new THREE.Raycaster();
  const seen = [];
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      caster.setFromCamera(new THREE.Vector2((2 * x + 1) / width - 1, (2 * y + 1) / height - 1), camera);
      const point = caster.ray.intersectSphere(ball, new THREE.Vector3());
      if (!point) continue;
      const normal = point.sub(ball.center).divideScalar(ball.radius);
      if (-normal.dot(caster.ray.direction) < 0.25) continue; // pixels of the edge are half sphere, half nothing
      const at = 4 * (y * width + x);
      seen.push({ normal: normal.toArray(), rgb: Array.from(rgba.slice(at, at + 3)), x: x / width });
    }
  }
  renderer.forceContextLoss();
  return seen;
}

const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
const luminance = (rgb) => dot(rgb, [0.2126, 0.7152, 0.0722]);
const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
const unit = (v) => v.map((value) => value / Math.hypot(...v));
const degrees = (radians) => (radians * 180) / Math.PI;
const angle = (a, b) => degrees(Math.acos(Math.max(-1, Math.min(1, dot(a, b)))));
const text = ([x, y, z]) =>
  `azimuth ${degrees(Math.atan2(x, z)).toFixed(1)}, elevation ${degrees(Math.asin(y)).toFixed(1)}`;

const spread = Array.from({ length: 4000 }, (_, i) => {
  const y = 1 - (2 * i + 1) / 4000;
  const turn = i * Math.PI * (3 - Math.sqrt(5));
  return [Math.sqrt(1 - y * y) * Math.cos(turn), y, Math.sqrt(1 - y * y) * Math.sin(turn)];
});

// Direction, to two degrees, of the one lamp that, with an even surround, explains the shading best.
function lampOf(normals, values) {
  const middle = mean(values);
  const fit = (direction) => {
    const shading = normals.map((normal) => Math.max(0, dot(normal, direction)));
    const even = mean(shading);
    const [along, own] = shading.reduce(
      ([a, o], s, i) => [a + (s - even) * (values[i] - middle), o + (s - even) ** 2],
      [0, 1e-9],
    );
    return along / Math.sqrt(own);
  };
  const fits = spread.map(fit);
  return spread[fits.indexOf(Math.max(...fits))];
}

// What a white matt surface shows in the report's first nine coefficients; order and constants as in docs/recipes.md.
function shown([x, y, z], sh) {
  const first = [0.282095, 0.488603 * y, 0.488603 * z, 0.488603 * x];
  const second = [x * y, y * z, z * z - 1 / 3, x * z, (x * x - y * y) / 2];
  const basis = [...first, ...second.map((term, i) => term * (i === 2 ? 0.946175 : 1.092548))];
  const lobe = [Math.PI, ...Array(3).fill((2 * Math.PI) / 3), ...Array(5).fill(Math.PI / 4)];
  return [0, 1, 2].map((c) => basis.reduce((sum, b, i) => sum + b * lobe[i] * sh[i][c], 0) / Math.PI);
}

// Mean of the right half of what is seen of the sphere over that of the left.
function rightOverLeft(seen) {
  const middle = mean(seen.map(({ x }) => x));
  const half = (wanted) => mean(seen.filter(wanted).map(({ rgb }) => luminance(rgb)));
  return half(({ x }) => x > middle) / half(({ x }) => x < middle);
}

function check(name, seen, light) {
  const normals = seen.map(({ normal }) => normal);
  expect(seen.length > 300, `${name}: the sphere is where the camera looks, ${seen.length} pixels`);
  const wanted = normals.map((normal) => shown(normal, light.spherical_harmonics.rgb));
  const [off, all] = seen.reduce(
    ([o, a], { rgb }, i) => {
      const apart = rgb.map((value, c) => value - wanted[i][c]);
      return [o + dot(apart, apart), a + dot(wanted[i], wanted[i])];
    },
    [0, 0],
  );
  // A matt sphere shows almost nothing above the second order; three.js blurs the map by samples, the harmonics it takes as they are.
  const error = Math.sqrt(off / all);
  expect(
    error < (name.endsWith('map') ? 0.03 : 0.001),
    `${name}: shading is ${(100 * error).toFixed(1)} % from the report's harmonics`,
  );

  const lamp = light.main_lights[0];
  const found = lampOf(
    normals,
    seen.map(({ rgb }) => luminance(rgb)),
  );
  const byHarmonics = lampOf(normals, wanted.map(luminance));
  const share = `${Math.round(100 * lamp.share_of_energy)} %`;
  for (const [what, direction, limit] of [
    ['the harmonics', byHarmonics, 10],
    [`the main light of ${share}`, lamp.direction, lamp.share_of_energy > dominant ? 20 : 45],
  ]) {
    const apart = angle(found, unit(direction));
    expect(
      apart < limit,
      `${name}: lamp at ${text(found)}; by ${what} ${text(unit(direction))}; ${apart.toFixed(1)} degrees off`,
    );
  }
  const ratio = rightOverLeft(seen);
  const right = lamp.direction[0] > 0;
  expect(
    right ? ratio > 1.2 : ratio < 1 / 1.2,
    `${name}: the right half is ${ratio.toFixed(2)} of the left, lamp at the ${right ? 'right' : 'left'}`,
  );
  return found;
}

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM,
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
try {
  const page = await browser.newPage();
  page.on('console', (message) => message.type() === 'error' && expect(false, `the browser says: ${message.text()}`));
  const recipes = blocks();
  let folder;
  const files = { '/three/': join(root, 'web/node_modules/three/'), '/photo/': () => `${folder}/` };
  await page.route(`${site}**`, (route) => {
    const { pathname } = new URL(route.request().url());
    const recipe = /^\/(\w+)\.js$/.exec(pathname)?.[1];
    if (recipe) return route.fulfill({ body: recipes[recipe], contentType: types['.js'] });
    if (pathname.endsWith('/')) {
      const map = { imports: { three: '/three/build/three.module.js', 'three/addons/': '/three/examples/jsm/' } };
      return route.fulfill({
        body: `<script type="importmap">${JSON.stringify(map)}</script>`,
        contentType: types['.html'],
      });
    }
    const [base] = Object.keys(files).filter((each) => pathname.startsWith(each));
    if (!base) return route.fulfill({ status: 404 }); // the browser's icon
    const within = typeof files[base] === 'string' ? files[base] : files[base]();
    return route.fulfill({
      path: join(within, pathname.slice(base.length)),
      contentType: types[extname(pathname)] ?? 'application/octet-stream',
    });
  });

  const sides = [];
  for (const [name, png] of await pictures(page)) {
    folder = join(work, name.replaceAll(' ', '_'));
    const file = `${folder}.png`;
    writeFileSync(file, png);
    const quick = ['--layer-px', '256', '--size', '128'];
    execFileSync(faceprobe, ['-q', 'estimate', file, '-o', join(folder, 'light'), ...quick], { stdio: 'inherit' });
    execFileSync(faceprobe, ['-q', 'estimate', file, '-o', join(folder, 'three.hdr'), '--orient', 'three', ...quick], {
      stdio: 'inherit',
    });
    const { faces, largest_face } = JSON.parse(readFileSync(join(folder, 'light/report.json'), 'utf8'));
    const { light } = faces[largest_face];
    sides.push(light.main_lights[0].direction[0]);
    for (const way of Object.keys(recipes)) {
      await page.goto(`${site}photo/`);
      check(`${name}, ${way}`, await page.evaluate(seenAfter, `/${way}.js`), light);
    }
  }
  expect(
    sides[0] > 0.2 && sides[1] < -0.2,
    `the main light turns over with the photo: x ${sides.map((x) => x.toFixed(2)).join(' and ')}`,
  );
} finally {
  await browser.close();
}
if (failures.length > 0) throw new Error(`${failures.length} failed`);
