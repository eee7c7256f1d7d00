// Tests over a real server, that fail on what a browser complains of, on requests that leave the machine, and on pages that ask people
// something. One server for all tests of a worker, with one estimate of one face and one of two, made when they are first wanted.
import { test as plain, expect, type Page } from '@playwright/test';

import { estimateOf, forgetAllBut, samplePhoto, startServer, stopServer, type Estimate, type Server } from './server.ts';
import { pictureOf, sideBySide } from './pictures.ts';

// What the browser says of the page, but for what the server refuses: people are told by the page, and the browser logs it all the same.
function listen(page: Page): string[] {
  const complaints: string[] = [];
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('console', (message) => {
    if (message.type() === 'error' && !/the server responded with a status of 4\d\d/.test(message.text()))
      complaints.push(message.text());
  });
  page.on('request', (request) => {
    const url = new URL(request.url());
    if (['http:', 'https:', 'ws:', 'wss:'].includes(url.protocol) && url.hostname !== '127.0.0.1')
      complaints.push(`a request left the machine: ${request.url()}`);
  });
  page.on('dialog', (dialog) => {
    complaints.push(`a dialog: ${dialog.message()}`);
    void dialog.dismiss();
  });
  return complaints;
}

interface Options {
  expectedComplaints: RegExp | null; // for tests that bring them about
}

interface PerTest {
  complaints: string[];
  tidy: void;
}

interface Shared {
  server: Server;
  oneFace: Estimate;
  twoFaces: Estimate;
  kept: Set<string>;
}

export const test = plain.extend<Options & PerTest, Shared>({
  expectedComplaints: [null, { option: true }],
  server: [
    async ({}, use) => {
      const server = await startServer();
      await use(server);
      await stopServer(server);
    },
    { scope: 'worker' },
  ],
  kept: [({}, use) => use(new Set()), { scope: 'worker' }],
  oneFace: [
    async ({ server, kept }, use) => {
      const estimate = await estimateOf(server, samplePhoto('grace_hopper.jpg'), 'Grace.jpg');
      kept.add(estimate.id);
      await use(estimate);
    },
    { scope: 'worker' },
  ],
  twoFaces: [
    async ({ server, kept, browser }, use) => {
      const page = await browser.newPage();
      await page.goto(server.address);
      const estimate = await estimateOf(server, await pictureOf(page, sideBySide), 'Two.png');
      await page.close();
      kept.add(estimate.id);
      await use(estimate);
    },
    { scope: 'worker' },
  ],
  baseURL: async ({ server }, use) => use(server.address),
  complaints: [
    async ({ page, expectedComplaints }, use) => {
      const complaints = listen(page);
      await use(complaints);
      const unexpected = complaints.filter((complaint) => !expectedComplaints?.test(complaint));
      expect(unexpected, 'what the browser complained of').toEqual([]);
    },
    { auto: true },
  ],
  // Every test finds the history as the first one did.
  tidy: [
    async ({ server, kept }, use) => {
      await use();
      await forgetAllBut(server, kept);
    },
    { auto: true },
  ],
});

export { expect };
