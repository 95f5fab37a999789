/**
 * Nothing lies after a loss: within half of a second of the last word no figure on any view looks live, and within a second one
 * banner says what has happened and what to do.
 */
import type { StageControl } from '@farpoint/webxr/stage-control';
import type { Page } from '@playwright/test';
import { headsetViewport } from '../src/headset.ts';
import { enterVr, wristOf } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

/** Limits after the robot's last word, ms. */
const [DEAD_MS, TOLD_MS] = [500, 1000];
/** What stays true without a word from the robot. */
const OF_THE_PAGE = ['Robot', 'Motion to photon', 'Remembered'];

/** Rows of the table of figures that still say something of the robot or its stream. */
async function liveRows(page: Page): Promise<string[]> {
  const rows = await page
    .locator('#facts')
    .evaluate((table) =>
      [...table.querySelectorAll('dt')].map(
        (name) => [name.textContent ?? '', name.nextElementSibling?.textContent ?? ''] as const,
      ),
    );
  expect(rows.length).toBeGreaterThan(5);
  return rows.filter(([name, value]) => !OF_THE_PAGE.includes(name) && value !== '–').map(([name]) => name);
}

/** A robot that is turning by the operator's hand falls silent in the middle of it. */
async function loseWhileDriving(stage: Stage, lose: (control: StageControl) => void): Promise<Page> {
  const page = await stage.open({ state: 'guard-blind' });
  await page.keyboard.down('Space');
  await stage.run(100);
  await page.keyboard.down('KeyA');
  await stage.run(500);
  await expect(page.locator('#holder')).toHaveText('You are driving (keyboard)');
  await expect(page.locator('#obstacle-guard')).toBeVisible();
  expect(await liveRows(page)).toContain('Speed');
  await stage.script(lose);
  return page;
}

const losses: Readonly<Record<string, { lose(control: StageControl): void; title: string }>> = {
  'the robot is killed': {
    lose: (control) => {
      control.cut();
      control.link.list([]);
    },
    title: 'The robot is gone',
  },
  'this computer’s network is gone': {
    lose: (control) => {
      control.cut();
      control.link.enterSignaling('waiting');
    },
    title: 'Your connection is lost',
  },
  'only the path between the two is gone': {
    lose: (control) => control.cut(),
    title: 'The robot does not answer',
  },
};

for (const [what, { lose, title }] of Object.entries(losses)) {
  test(`${what}: no figure looks live, and the banner says which side it is`, async ({ stage }) => {
    const page = await loseWhileDriving(stage, lose);
    const banner = page.locator('#banner');
    await expect(banner).toBeHidden();
    await stage.run(DEAD_MS);
    expect(await liveRows(page)).toEqual([]);
    await expect(page.locator('#holder')).toHaveText('The robot does not hear you');
    for (const bound of ['#obstacle-guard', '#motion-state', '#speed'])
      await expect(page.locator(bound)).toBeHidden();
    await expect(page.locator('#link')).not.toHaveAttribute('data-tone', 'good');
    expect(await page.locator('#facts [data-tone="good"]').count()).toBe(0);
    await stage.run(TOLD_MS - DEAD_MS);
    await expect(banner).toBeVisible();
    await expect(banner).toHaveRole('alert');
    await expect(banner.locator('b')).toHaveText(title);
    await expect(banner).toContainText('stops by itself');
    // Keys that are held move nothing any more.
    await expect(banner).toContainText(/Let go of the grip\.$/);
    await page.keyboard.up('KeyA');
    await page.keyboard.up('Space');
    await stage.run(300);
    await expect(banner).not.toContainText('Let go');
    // The one age.
    await stage.run(3000);
    await expect(page.locator('#link')).toHaveText(/^Connection lost for [45] s$/);

    await stage.script((control) => {
      control.link.enterSignaling('ready');
      control.link.list([{ id: control.robot.id, name: control.robot.name }]);
      control.restore();
    });
    await stage.run(1500);
    await expect(banner).toBeHidden();
    expect(await liveRows(page)).toContain('Speed');
    await expect(page.locator('#obstacle-guard')).toBeVisible();
  });
}

test('a loss of the signaling service alone changes nothing but the link’s line', async ({ stage }) => {
  const page = await stage.open();
  await stage.script(({ link }) => link.enterSignaling('waiting'));
  await stage.run(2000);
  await expect(page.locator('#banner')).toBeHidden();
  await expect(page.locator('#link')).toHaveText('Live (signaling offline)');
  expect(await liveRows(page)).toContain('Speed');
});

test('a decoder that hangs makes its own figures dead, and no others', async ({ stage }) => {
  const page = await stage.open();
  const before = await liveRows(page);
  expect(before).toEqual(expect.arrayContaining(['Points', 'Rate', 'Loss', 'State', 'Round trip']));
  await stage.script((control) => control.stream(null));
  await stage.run(DEAD_MS);
  const after = await liveRows(page);
  expect(after).toEqual(expect.arrayContaining(['State', 'Speed', 'Round trip']));
  for (const dead of ['Points', 'Rate', 'Loss', 'View age']) expect(after).not.toContain(dead);
  await stage.run(3000);
  await expect(page.locator('#link')).toHaveText('Connected, but no points are arriving.');
});

test('a robot that is heard but does not hear is told of', async ({ stage }) => {
  const page = await stage.open();
  await stage.script(({ robot }) => {
    const { onSent } = robot;
    robot.onSent = (message) => {
      if (message.type !== 'clockProbe') onSent.call(robot, message);
    };
  });
  await stage.run(4000);
  await expect(page.locator('#banner b')).toHaveText('The robot does not hear you');
  await expect(page.locator('#holder')).toHaveText('The robot does not hear you');
  // What is seen is live.
  expect(await liveRows(page)).toContain('Speed');
});

test('the dashboard beside it goes stale as soon', async ({ stage }) => {
  const page = await stage.open({ state: 'live' });
  await page.locator('#dashboard-open').click();
  const speed = page.locator('#dashboard').getByRole('region', { name: 'Speed', exact: true });
  await speed.waitFor();
  await stage.run(1000);
  await expect(speed.locator('[data-stale]').first()).toHaveAttribute('data-stale', 'false');
  await stage.script((control) => control.cut());
  await stage.run(DEAD_MS);
  await expect(page.locator('#dashboard .state')).toHaveText(/^No data from the robot for/);
  await expect(page.locator('#dashboard [data-stale="false"]')).toHaveCount(0);
});

test('without a session the banner says what is missing, and stays until it is there', async ({ stage }) => {
  const page = await stage.open({ state: 'unknown-robot' });
  const banner = page.locator('#banner');
  await expect(banner).toContainText('“rover-that-nobody-knows”');
  await stage.script(({ link }) => link.enterSignaling('refused'));
  await stage.run(300);
  await expect(banner).toContainText('refused the token');
  await stage.script(({ link }) => link.enterSignaling('waiting'));
  await stage.run(300);
  await expect(banner).toContainText('Cannot reach the signaling service');
});

test('a robot that was shut down: the banner stays until it is back', async ({ stage }) => {
  const page = await stage.open({ state: 'robot-gone', forMs: 3000 });
  const banner = page.locator('#banner');
  await expect(banner).toContainText('The robot is offline');
  await expect(page.locator('#estop')).toBeVisible();
  await stage.script(({ link, robot }) => link.list([{ id: robot.id, name: robot.name }]));
  await stage.run(6000);
  await expect(banner).toBeHidden();
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('no figure on the wrist looks live without a word from the robot', async ({ stage }) => {
    await enterVr(stage);
    const lines = async () => (await wristOf(stage)).map(({ text }) => text);
    await stage.run(500);
    const alive = (await lines()).join();
    expect(alive).toMatch(/rtt \d+ ms/);
    expect(alive).toContain('Battery');
    await stage.script((control) => control.cut());
    await stage.run(DEAD_MS);
    const dead = await lines();
    expect(dead).toContain('rtt –  view –  loss –');
    expect(dead).toContain('points –');
    expect(dead.join()).not.toMatch(/m\/s|Battery|Stationary|Driving|Live/);
  });
});

test('the band of a stop says that it is as last heard, and no control releases it, until the robot is back', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'stop-latched' });
  const [band, release] = [page.locator('#stop-band'), page.locator('#estop-release')];
  await expect(release).toBeVisible();
  await stage.script((control) => control.cut());
  await stage.run(DEAD_MS);
  await expect(band).toContainText('before it fell silent');
  await expect(release).toBeHidden();
  await page.keyboard.down('KeyR');
  await stage.run(1200);
  await page.keyboard.up('KeyR');
  expect((await stage.sent('estop')).filter((message) => 'latch' in message && !message.latch)).toEqual([]);
});
