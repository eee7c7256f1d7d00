// The page as people use it, in Debian's Chromium, over the real server; run.sh says what it needs.
import { defineConfig } from '@playwright/test';

const chromium = (...graphics: string[]) => ({
  launchOptions: {
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-fake-device-for-media-stream', '--use-fake-ui-for-media-stream', ...graphics],
  },
});

export default defineConfig({
  testDir: '.',
  outputDir: process.env.PAGE_TEST_OUTPUT ?? '../.test/e2e',
  workers: 1, // an estimate takes all processors
  timeout: 180_000, // of one test, on two busy processors
  expect: { timeout: 60_000 },
  reporter: [['list']],
  use: { browserName: 'chromium', viewport: { width: 1280, height: 900 } },
  projects: [
    // A machine for tests has no graphics card, and the processor takes seconds to draw the 3D view. So most tests see the page as a
    // browser without WebGL has it, where all the rest must work as well.
    { name: 'without 3D', testIgnore: /stage\.spec/, use: chromium('--disable-gpu', '--disable-3d-apis') },
    { name: 'in 3D', testMatch: /stage\.spec/, use: chromium('--use-angle=swiftshader', '--enable-unsafe-swiftshader') },
  ],
});
