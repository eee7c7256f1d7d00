// What holds in every state of the page: nothing that axe calls serious or critical, dark or light, and no sideways scrolling where it is narrow.
import { AxeBuilder } from '@axe-core/playwright';
import { expect, type Page, type TestInfo } from '@playwright/test';

import { keepPicture } from './page.ts';

const wide = { width: 1280, height: 900 };
const narrow = { width: 320, height: 640 };

async function seriousFindings(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).setLegacyMode().analyze(); // legacy: there are no frames, and no second page is needed
  return violations
    .filter(({ impact }) => impact === 'serious' || impact === 'critical')
    .flatMap(({ id, nodes }) => nodes.map(({ html, failureSummary }) => `${id}: ${html} ${failureSummary}`));
}

// What is wider than the window, or sticks out of its card; for the one who has to mend it.
function sidewaysOf(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const beyond = (part: Element, right: number) =>
      Array.from(part.querySelectorAll('*'))
        .filter((element) => element.getBoundingClientRect().right > right + 0.5)
        .map((element) => element.outerHTML.slice(0, 100));
    const window = document.documentElement;
    const cards = Array.from(document.querySelectorAll('.card')).filter((card) => card.scrollWidth > card.clientWidth);
    return [
      ...(window.scrollWidth > innerWidth ? beyond(window, innerWidth) : []),
      ...cards.flatMap((card) => beyond(card, card.getBoundingClientRect().right)),
    ];
  });
}

export async function expectAccessible(page: Page, info: TestInfo, state: string): Promise<void> {
  for (const theme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme: theme, reducedMotion: 'reduce' }); // colours that fade in have little contrast at first
    expect(await seriousFindings(page), `${state}, ${theme}`).toEqual([]);
    await page.evaluate(() => scrollTo(0, 0));
    await keepPicture(page, info, `${state}-${theme}`);
  }
  await page.setViewportSize(narrow);
  await keepPicture(page, info, `${state}-narrow`);
  expect(await sidewaysOf(page), `${state}, ${narrow.width} px wide`).toEqual([]);
  await page.setViewportSize(wide);
}
