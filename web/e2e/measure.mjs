// The page in figures: measure.mjs FACEPROBE PHOTO PAGE_FOLDER [RUNS] prints a Markdown table. bench/page.sh says what is needed.
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { basename } from 'node:path';
import { createInterface } from 'node:readline';
import { chromium } from 'playwright-core';

import { packedFiles } from './size.mjs';

const [command, photo, folder, runs = '5'] = process.argv.slice(2);

function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  return (sorted[(sorted.length - 1) >> 1] + sorted[sorted.length >> 1]) / 2;
}

async function startServer() {
  const child = spawn(command, ['-q', 'serve', '--port', '0'], { stdio: ['ignore', 'pipe', 'inherit'] });
  for await (const line of createInterface({ input: child.stdout })) return { address: line.trim(), child };
  throw new Error(`${command} serve ended before it named its address.`);
}

// In the page. As the browser's own clock has it, from the beginning of the navigation.
const firstPaint = () =>
  new Promise((resolve) => {
    new PerformanceObserver((list) => {
      const [entry] = list.getEntriesByName('first-contentful-paint');
      if (entry) resolve(entry.startTime);
    }).observe({ type: 'paint', buffered: true });
  });

// In the page: from the drop until the panorama has its pixels, looked at before every frame.
const dropToMap = (base64) =>
  new Promise((resolve) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([bytes], 'photo.jpg', { type: 'image/jpeg' }));
    const begin = performance.now();
    document.body.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, cancelable: true }));
    const look = () => {
      const canvas = document.querySelector('.panorama-frame canvas');
      const drawn = canvas?.getContext('2d').getImageData(0, 0, 1, 1).data[3] === 255;
      if (drawn) resolve(performance.now() - begin);
      else requestAnimationFrame(look);
    };
    look();
  });

const { address, child } = await startServer();
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM,
  args: ['--no-sandbox', '--disable-gpu', '--disable-3d-apis'], // without a graphics card the 3D view takes the processors from the estimate
});
const paints = [];
const maps = [];
try {
  const base64 = readFileSync(photo).toString('base64');
  for (let run = 0; run < Number(runs); ++run) {
    const page = await browser.newPage(); // with a cache of its own, which is empty
    await page.goto(address);
    paints.push(await page.evaluate(firstPaint));
    await page.getByRole('button', { name: 'Choose a photo' }).waitFor();
    maps.push(await page.evaluate(dropToMap, base64));
    await page.close();
  }
} finally {
  await browser.close();
  child.kill('SIGTERM');
}

const files = packedFiles(folder);
const packed = (wanted) => files.filter(wanted).reduce((sum, { bytes }) => sum + bytes, 0);
const seconds = (milliseconds) => (milliseconds / 1000).toFixed(1);
console.log(`The page of \`faceprobe serve\` in Chromium ${browser.version()} without 3D, on the same machine as the server; medians of
${runs} runs with an empty cache, and ${basename(photo)} as the photo:

| | |
| --- | ---: |
| scripts and styles, gzip -6 | ${packed(() => true)} bytes |
| of them for the first paint | ${packed(({ path }) => /(^|\/)(index|theme)\b[^/]*$/.test(path))} bytes |
| first contentful paint | ${Math.round(median(paints))} ms |
| from the drop of a photo to its map | ${seconds(median(maps))} s |
| the slowest of these | ${seconds(Math.max(...maps))} s |`);
