// A page from elsewhere that a person has open beside Faceprobe gets nothing from it and does nothing to it.
import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';

import { test, expect } from './served.ts';
import { get, type Estimate } from './server.ts';

test.use({ expectedComplaints: /blocked by CORS policy|net::ERR_(FAILED|BLOCKED_BY_RESPONSE)|violates the following/ });

test('another page cannot read, post or show', async ({ page, server, oneFace }) => {
  const foreign = createServer((_, answer) => answer.setHeader('content-type', 'text/html').end('<title>Other</title>'));
  await new Promise<void>((resolve) => foreign.listen(0, '127.0.0.1', resolve));
  const names = async () => (await get<Estimate[]>(server, '/estimates')).map(({ name }) => name);
  const before = await names();
  try {
    const other = `http://127.0.0.1:${(foreign.address() as AddressInfo).port}/`;
    for (const address of [other, 'data:text/html,<title>Other</title>']) {
      await page.goto(address);
      const got = await page.evaluate(
        async ([api, id]) => {
          const read = (path: string, init?: RequestInit) =>
            fetch(api + path, init).then(
              (response) => `${response.type} ${response.status}`,
              () => 'refused',
            );
          const image = new Image();
          image.src = `${api}/estimates/${id}/photo`;
          return {
            read: await read('/estimates'),
            post: await read('/estimates', { method: 'POST', body: JSON.stringify({ sample: 'astronaut' }) }),
            blind: await read('/estimates', { method: 'POST', mode: 'no-cors', body: new Blob(['x']) }),
            remove: await read(`/estimates/${id}`, { method: 'DELETE' }),
            image: await image.decode().then(
              () => 'shown',
              () => 'refused',
            ),
          };
        },
        [`${server.address}api/v1`, oneFace.id],
      );
      // Of a request without CORS a page is told nothing: the answer is opaque, if the browser lets it through at all.
      expect(got, address).toEqual({
        read: 'refused',
        post: 'refused',
        blind: expect.stringMatching(/^(opaque 0|refused)$/),
        remove: 'refused',
        image: 'refused',
      });
    }
    expect(await names()).toEqual(before);
  } finally {
    foreign.close();
  }
});
