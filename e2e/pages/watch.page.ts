/** The watchers' page: what it says while it can't show anything, and of pictures that are not live. */
import type { Page } from '@playwright/test';
import { screenSizes } from '../src/screens.ts';
import { expectNothingCovered } from '../src/stage/boxes.ts';
import { expect, test } from '../src/stage/page-test.ts';
import { broadcastOf, JANUS_URL, type JanusAnswer, ScriptedJanus } from '../src/stage/scripted-janus.ts';
import type { Stage } from '../src/stage/stage.ts';

const link = (page: Page) => page.locator('#link');

async function expectLink(page: Page, words: string, tone: string): Promise<void> {
  await expect(link(page)).toHaveText(words);
  await expect(link(page)).toHaveAttribute('data-tone', tone);
}

/** Opens the page. The waits between its attempts have the middle of their lengths. */
async function watch(stage: Stage, query: Readonly<Record<string, string>>): Promise<Page> {
  await stage.page.addInitScript(() => {
    Math.random = () => 0.5;
  });
  return stage.openOwn(query, '/watch.html');
}

const attempts = (page: Page) => page.evaluate(() => window.farpointWatch?.stats().attempts);

const obstacles: readonly [answer: JanusAnswer, words: string, tone: string, waitMs: number][] = [
  ['no-mountpoint', 'The robot is not broadcasting. Waiting for it…', 'warning', 300],
  ['wrong-pin', 'Janus refuses: check the PIN. Trying again…', 'bad', 600],
  ['not-a-robot', 'This mountpoint is not a robot’s broadcast. Trying again…', 'bad', 1200],
  ['away', 'Janus cannot be reached. Trying again…', 'warning', 2400],
  ['no-mountpoint', 'The robot is not broadcasting. Waiting for it…', 'warning', 4000],
  ['away', 'Janus cannot be reached. Trying again…', 'warning', 4000],
];

test('the page says why it shows nothing, and tries again, less and less often', async ({ stage }) => {
  const janus = await ScriptedJanus.open(stage.page);
  janus.answer = 'no-mountpoint';
  await watch(stage, {});
  await expect(stage.page.locator('#failure')).toContainText(
    'The address of Janus is missing: add ?janus=wss://… to the page’s address.',
  );
  await expect(link(stage.page)).toBeHidden();
  const page = await watch(stage, { janus: JANUS_URL, mountpoint: '3', pin: 'look' });
  for (const [i, [, words, tone, waitMs]] of obstacles.entries()) {
    await expectLink(page, words, tone);
    janus.answer = obstacles[i + 1]?.[0] ?? broadcastOf('Rover', ['Front', 'Rear']);
    await stage.run(waitMs - 1);
    expect(await attempts(page)).toBe(i + 1);
    await stage.run(1);
    expect(await attempts(page)).toBe(i + 2);
  }
  await expect(page.locator('#pictures figure')).toHaveCount(2);
  await expectLink(page, 'Connecting…', 'neutral');
  const asked = { request: 'watch', id: 3, pin: 'look' };
  expect(janus.watched).toEqual([asked, asked]);
});

test('pictures that are not live are frozen, grey and dated until others come', async ({ stage }) => {
  const janus = await ScriptedJanus.open(stage.page);
  janus.answer = broadcastOf('Rover', ['Front', 'Rear']);
  const page = await watch(stage, { janus: JANUS_URL });
  const panels = page.locator('#pictures figure');
  const expectPanels = async (state: string, words: string) => {
    await expect(panels).toHaveCount(2);
    for (const panel of await panels.all()) {
      await expect(panel).toHaveAttribute('data-state', state);
      await expect(panel.locator('.age')).toHaveText(words);
    }
  };
  await expectPanels('waiting', 'waiting');
  await expect(panels.locator('canvas').first()).toBeHidden();
  const showPictures = () =>
    page.evaluate(() => {
      for (const video of [0, 1]) window.farpointWatch?.showPicture(video);
    });
  await showPictures();
  for (const { width, height } of screenSizes) {
    await stage.resize(width, height);
    const seen = await expectNothingCovered(page, `watch, ${width} wide`);
    expect(seen).toEqual(expect.arrayContaining(['link', 'from-above', 'view', 'pictures']));
  }
  await showPictures();
  await stage.run(250);
  // They have just come, and nothing says that others follow.
  await expectPanels('frozen', 'not live, 0 s');
  await stage.run(750);
  await expectPanels('frozen', 'not live, 1 s');
  await janus.stop();
  await expectLink(page, 'The connection is lost. Trying again…', 'warning');
  for (const canvas of await panels.locator('canvas').all()) {
    await expect(canvas).toBeVisible();
    await expect(canvas).toHaveCSS('filter', /grayscale\(1\)/);
  }
  // The first attempt finds nobody, and the second the robot, whose pictures are yet to come.
  await stage.run(300);
  await expectLink(page, 'Janus cannot be reached. Trying again…', 'warning');
  janus.answer = broadcastOf('Rover', ['Front', 'Rear']);
  await stage.run(599);
  await expectPanels('frozen', 'not live, 2 s');
  await stage.run(1);
  await expectPanels('waiting', 'waiting');
  await expect(panels.locator('canvas').first()).toBeHidden();
});
