/** The list of robots: what each tells, found, chosen by keys, and how it was last seen. */
import type { Page } from '@playwright/test';
import { expect, test } from '../src/stage/page-test.ts';

const card = (page: Page, name: string) =>
  page.locator('#robot-list').getByRole('button', { name, exact: false });
const names = (page: Page) => page.locator('#robot-list .name').allTextContents();

test('says what each robot does, finds one, and goes through them by arrow keys', async ({ stage }) => {
  const page = await stage.open({ state: 'fleet', canvas: '64x36' });
  await stage.run(300);
  expect((await names(page)).slice(0, 3)).toEqual([
    'Mule with a name of sixty-four characters, as long as one can be',
    'Robot 1',
    'Robot 2',
  ]);
  await expect(card(page, 'robot-2').locator('.words')).toHaveText(
    /Driven by Ada since .*1 alarm.*Battery 8 %.*1 of 4 operators.*1 watching/,
  );
  await expect(card(page, 'robot-3').locator('[data-tone="bad"]')).toHaveText(/^STOP on since /);
  const field = page.getByRole('searchbox', { name: 'Find a robot by name or id' });
  await field.fill('MULE');
  await stage.run(300);
  expect(await names(page)).toHaveLength(1);
  await expect(page.locator('#robots-search')).toContainText('1 of 12 robots');
  await expect(page.getByRole('link', { name: 'Side by side' })).toBeHidden();
  await field.fill('robot 1');
  await stage.run(300);
  // Robot 1, 10, 11 and 12: letters are text here, and neither stop nor switch.
  await field.press('ArrowDown');
  await page.keyboard.press('ArrowDown');
  await expect(card(page, 'robot-10')).toBeFocused();
  const link = page.getByRole('link', { name: 'Side by side' });
  await expect(link).toHaveAttribute('href', /^\.\/wall\.html\?.*robots=robot-1,robot-10,robot-11,robot-12$/);
  await page.keyboard.press('Enter');
  await stage.run(300);
  expect(await stage.script(({ app }) => app.client.chosenRobotId)).toBe('robot-10');
});

test('a change among 200 robots touches one card, keeps the focus, and is quick', async ({ stage }) => {
  const page = await stage.open({ state: 'fleet', canvas: '64x36' });
  const changed = await page.evaluate(async () => {
    const { link, app } = window.farpointStage;
    const status = { sinceMs: 0, operators: 0, watchers: 0, maxOperators: 4, alarms: 0 };
    const robots = Array.from({ length: 200 }, (_, i) => ({ id: `r-${i}`, name: `Robot ${i}` }));
    const tell = (stopped: string) => {
      link.statusFeed = {
        statuses: new Map(
          robots.map(({ id }) => [
            id,
            { ...status, state: id === stopped ? ('stopped' as const) : ('free' as const) },
          ]),
        ),
        watchStatuses: () => undefined,
      };
      app.state.sample();
    };
    link.list(robots);
    tell('');
    document.querySelector<HTMLButtonElement>('[data-robot="r-150"]')?.focus();
    const touched = new Set<Element | null | undefined>();
    const observer = new MutationObserver((records) => {
      for (const { target } of records)
        touched.add((target as Element).closest?.('li') ?? (target as Element));
    });
    observer.observe(document.querySelector('#robot-list')!, {
      childList: true,
      subtree: true,
      characterData: true,
    });
    tell('r-7');
    for (const record of observer.takeRecords()) touched.add((record.target as Element).closest('li'));
    return {
      cards: document.querySelectorAll('#robot-list li').length,
      touched: [...touched].map((each) => each?.textContent ?? ''),
      focused: (document.activeElement as HTMLElement).dataset.robot,
    };
  });
  expect(changed.cards).toBe(200);
  expect(changed.touched).toHaveLength(1);
  expect(changed.touched[0]).toContain('Robot 7');
  expect(changed.touched[0]).toContain('STOP on since');
  expect(changed.focused).toBe('r-150');
});

test('keeps the last picture of a robot that was shown, in this browser only', async ({ stage }) => {
  const page = await stage.open({ state: 'live', canvas: '320x180' });
  await stage.run(11_000);
  await page.getByRole('button', { name: 'Disconnect' }).click();
  await stage.run(300);
  const picture = page.locator('#robot-list img');
  await expect(picture).toBeVisible();
  await expect(page.locator('#robot-list .age')).toHaveText('Seen here just now');
  const source = await picture.getAttribute('src');
  expect(source).toMatch(/^data:image\/jpeg;base64,/);
  expect(source!.length).toBeLessThan(27_000);
  await stage.run(130_000);
  await expect(page.locator('#robot-list .age')).toHaveText('Seen here 2 min ago');
});
