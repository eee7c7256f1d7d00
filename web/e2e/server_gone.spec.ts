// The server is stopped while the page is open.
import { partsOf } from './page.ts';
import { test, expect } from './served.ts';
import { estimateOf, samplePhoto, startServer, stopServer } from './server.ts';

test.use({ expectedComplaints: /Failed to load resource: net::ERR_/ });

const sentence = 'Faceprobe does not answer. Start `faceprobe serve` again';

test('a page that asks a server that is gone says so', async ({ page }) => {
  const server = await startServer();
  try {
    const { id } = await estimateOf(server, samplePhoto('grace_hopper.jpg'), 'Grace.jpg');
    await page.goto(`${server.address}?estimate=${id}`);
    await expect(partsOf(page).render).toBeEnabled();
    await stopServer(server);
    await partsOf(page).render.click();
    await expect(page.getByRole('alert').filter({ hasText: sentence })).toBeVisible();
    await expect(partsOf(page).render).toBeEnabled();
    await page.getByRole('button', { name: 'New photo' }).click();
    await page.getByRole('button', { name: 'Grace Hopper, US Navy' }).click();
    await expect(page.getByRole('alert').filter({ hasText: sentence })).toBeVisible();
  } finally {
    await stopServer(server);
  }
});

test('an estimate whose server goes away ends in a sentence', async ({ page }) => {
  const server = await startServer();
  try {
    await page.goto(server.address);
    await page.getByRole('button', { name: 'Grace Hopper, US Navy' }).click();
    await expect(partsOf(page).estimating).toBeVisible();
    server.process.kill('SIGKILL');
    await expect(page.getByRole('alert').filter({ hasText: sentence })).toBeVisible();
    await expect(partsOf(page).estimating).toBeHidden();
    await expect(partsOf(page).chooseAnother).toBeVisible();
  } finally {
    await stopServer(server);
  }
});
