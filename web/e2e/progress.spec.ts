// What the page says while an estimate is made: the server's own stages, in their order.
import { readdirSync, readFileSync } from 'node:fs';

import { expectMap, partsOf } from './page.ts';
import { test, expect } from './served.ts';
import { forget, postInsertion, postPhoto, samplePhoto } from './server.ts';

// The sentences of the server's sources.
const folder = new URL('../../apps/serve/', import.meta.url);
const sources = readdirSync(folder).filter((file) => file.endsWith('.cpp'));
const stages = sources.flatMap((file) => {
  const text = readFileSync(new URL(file, folder), 'utf8');
  const patterns = [/progress\("([^"]+)", /g, /NextStage\{"[^"]+", "([^"]+)"/g];
  return patterns.flatMap((pattern) => Array.from(text.matchAll(pattern), ([, name]) => name!));
});
// Those that take longer than the 50 ms between two events, on any machine.
const long = ['Looking for faces', 'Separating highlights', 'Solving for the light', 'Writing files'];

test('the stages are named', async ({ page, server, oneFace }) => {
  expect(stages, 'in apps/serve').toEqual(expect.arrayContaining(long));
  // Behind something slow, so that the page listens before the estimate begins.
  const slow = await postInsertion(server, oneFace.id, { object: 'robot', quality: 'final' });
  const { id } = await postPhoto(server, samplePhoto('grace_hopper.jpg'), 'Stages.jpg');
  await page.goto(`/?estimate=${id}`);
  await expect(page.getByRole('status')).toHaveText('Waiting for its turn');
  const told = await page.evaluateHandle(() => {
    const seen = { stages: [] as string[], shares: [] as number[] };
    const look = () => {
      const stage = document.querySelector('[role=status]')?.textContent;
      const share = document.querySelector('progress')?.getAttribute('value');
      if (stage && stage !== seen.stages.at(-1)) seen.stages.push(stage);
      if (share) seen.shares.push(Number(share));
    };
    new MutationObserver(look).observe(document, { subtree: true, childList: true, characterData: true, attributes: true });
    return seen;
  });
  await forget(server, `/insertions/${slow.id}`);
  await expectMap(page);
  await expect(partsOf(page).estimating).toBeHidden();
  const { stages: seen, shares } = await told.jsonValue();
  const begun = seen.filter((stage) => stages.includes(stage));
  expect(begun.filter((stage) => long.includes(stage))).toEqual(long);
  expect(seen.filter((stage) => stage !== 'Waiting for its turn' && !stages.includes(stage)), 'made up').toEqual([]);
  expect(shares, 'never backwards').toEqual([...shares].sort((a, b) => a - b));
});
