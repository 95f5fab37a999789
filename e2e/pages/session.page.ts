/** Sessions that are refused, lost, switched and resumed, as the page says and does it. */
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

/** Holds the grip, and pushes forward. */
async function drive(stage: Stage): Promise<void> {
  await stage.page.keyboard.down('Space');
  await stage.run(100);
  await stage.page.keyboard.down('KeyW');
  await stage.run(300);
  expect((await stage.state()).driving).toBe(true);
}

async function letGo(stage: Stage): Promise<void> {
  await stage.page.keyboard.up('KeyW');
  await stage.page.keyboard.up('Space');
  await stage.run(200);
}

test('a second robot: the first one stops before the page leaves it, and the other waits until the grip is let go', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'disconnected' });
  await page.getByRole('button', { name: /Robot on a stage/ }).click();
  await stage.run(400);
  await drive(stage);
  // While it drives, with the keys still held: it obeys with a delay.
  await stage.script(({ robot }) => {
    robot.delayMs = 100;
  });
  await stage.forget();
  await page.getByRole('combobox', { name: 'Robot' }).selectOption('stage-2');
  await stage.run(50);
  expect((await stage.state()).robotId).toBe('stage-1');
  expect((await stage.sent('command')).at(-1)).toMatchObject({ deadMan: false });
  expect(await stage.sent('leaseRelease')).toHaveLength(1);
  await stage.run(1000);
  expect(await stage.state()).toMatchObject({
    ...{ robotId: 'stage-2', session: 'live', holder: 'nobody', driving: false },
  });
  await stage.forget();
  await stage.run(1000);
  expect((await stage.sent('command')).filter(({ deadMan }) => deadMan)).toEqual([]);
  // Let go and gripped again: now the other robot drives.
  await letGo(stage);
  await drive(stage);
  await letGo(stage);
  // Back with a key.
  await page.keyboard.press('KeyN');
  await stage.run(1500);
  expect((await stage.state()).robotId).toBe('stage-1');
  await page.getByRole('button', { name: 'Disconnect' }).click();
  await stage.run(300);
  await expect(page.getByRole('button', { name: /Another robot/ })).toBeVisible();
});

test('signaling that is lost while driving changes nothing, and comes back', async ({ stage }) => {
  const page = await stage.open();
  await drive(stage);
  await stage.script(({ link }) => {
    link.enterSignaling('waiting');
    link.list([]);
  });
  await stage.run(5000);
  expect(await stage.state()).toMatchObject({ session: 'live', driving: true, signaling: 'waiting' });
  await stage.script(({ link, robot }) => robot.appear(link));
  await stage.run(500);
  expect(await stage.state()).toMatchObject({
    ...{ session: 'live', driving: true, signaling: 'ready', robotListed: true, sessionsOpened: 1 },
  });
  await letGo(stage);
  await expect(page.locator('#link')).toHaveText('Live');
});

test('a path that is away for a while: the grip is lost, the session stays, and a fresh grip drives', async ({
  stage,
}) => {
  const page = await stage.open();
  await drive(stage);
  await stage.script((stage) => stage.cut());
  await stage.run(900);
  expect((await stage.state()).driving).toBe(true);
  await stage.run(500);
  await expect(page.locator('#link')).toHaveText(/Connection lost for \d s/);
  expect((await stage.state()).driving).toBe(false);
  await stage.freeze();
  await stage.run(33_000);
  await expect(page.locator('#link')).toHaveText(/Connection lost for 3\d s/);
  await stage.thaw();
  await stage.script((stage) => stage.restore());
  await stage.run(1000);
  // The keys are held all the time.
  expect(await stage.state()).toMatchObject({
    ...{ session: 'live', sessionsOpened: 1, driving: false, gripLost: 'path-lost' },
  });
  await letGo(stage);
  await drive(stage);
});

test('a robot that was killed and comes back: the page says so, reconnects, and its stop stays until it is released', async ({
  stage,
}) => {
  const page = await stage.open();
  await stage.script(({ link }) => {
    link.list([]);
    link.end('connection-lost');
  });
  await stage.run(500);
  expect((await stage.state()).robotListed).toBe(false);
  await expect(page.getByText(/lost|offline|restarted/i).first()).toBeVisible();
  await stage.script(({ link, robot }) => {
    robot.estop = { type: 'estop', latched: true, by: 'robot', latch: 1 };
    robot.appear(link);
  });
  await stage.run(1500);
  expect(await stage.state()).toMatchObject({ session: 'live', sessionsOpened: 2, estop: true });
  await page.keyboard.down('KeyR');
  await stage.run(1200);
  await page.keyboard.up('KeyR');
  expect((await stage.state()).estop).toBe(false);
});

test('without a headset the page says why there is no VR', async ({ stage }) => {
  const page = await stage.open({ state: 'disconnected' });
  await expect(page.locator('#vr-reason')).toHaveText(/headset|WebXR/);
  await expect(page.getByRole('button', { name: 'Enter VR' })).toBeHidden();
});
