/** Real networks between a real browser and a robot. What outages do is asked in virtual time: tools/scenario. */
import {
  chromiumLaunchOptions,
  freePorts,
  hasTurnServer,
  TURN_REMEDY,
  TurnServer,
} from '@farpoint/local-stack';
import { chromium } from '@playwright/test';
import { expectStanding, OperatorPage, poseOf } from '../src/operator-page.ts';
import { robotLike } from '../src/robots.ts';
import { expect, test } from '../src/smoke-test.ts';

const ROUND_TRIP_MS = 40;

test('a browser that hides its addresses behind mDNS names is also led through an emulated link', async ({
  shared,
  startBehindLink,
}) => {
  const options = chromiumLaunchOptions();
  const args = (options.args ?? []).filter((flag) => !flag.includes('WebRtcHideLocalIpsWithMdns'));
  const robot = robotLike('hidden');
  await startBehindLink(robot, ['--rtt-ms', String(ROUND_TRIP_MS)]);
  const browser = await chromium.launch({ ...options, args });
  try {
    const page = await browser.newPage();
    const operator = await OperatorPage.open(page, shared.stack.webUrl, { robot: robot.id });
    await operator.expectPoints();
    expect((await operator.stats()).minRttMs).toBeGreaterThanOrEqual(ROUND_TRIP_MS);
  } finally {
    await browser.close();
  }
});

test('all addresses change while driving: the robot stands, and drives again in the same session', async ({
  page,
  shared,
  startBehindLink,
}) => {
  const robot = robotLike('moving', '--bitrate-mbps', '6');
  const link = await startBehindLink(robot, ['--rate-mbps', '20', '--rtt-ms', '30']);
  const operator = await OperatorPage.open(page, shared.stack.webUrl, { robot: robot.id });
  await operator.expectPoints();
  const start = await poseOf(operator);
  await operator.hold(operator.script);
  await operator.expectMovedFrom(start, 0.2);

  await link.renumber();
  // No path but the new one brings frames.
  await operator.expectState('driving', false);
  await operator.expectFrames(5);
  await expectStanding(operator);
  expect(await operator.state()).toMatchObject({ session: 'live', sessionsOpened: 1, driving: false });
  await operator.release();
  await operator.drives(0.1);
});

test('through a TURN relay only: points and commands arrive, and a restarted relay is found again', async ({
  page,
  startStack,
}) => {
  test.skip(!hasTurnServer(), `no turnserver here: ${TURN_REMEDY}`);
  const turn = new TurnServer((await freePorts(1))[0] as number);
  await turn.start();
  try {
    const robot = robotLike('relayed', '--ice-policy', 'relay', '--bitrate-mbps', '6');
    const stack = await startStack({
      signalingArgs: ['--turn-urls', turn.url, '--turn-secret', turn.secret],
      robots: [robot],
    });
    const operator = await OperatorPage.open(page, stack.webUrl, { robot: robot.id, ice: 'relay' });
    await operator.expectPoints();
    await operator.drives(0.1);

    // There is no other path, and the relay has forgotten both peers.
    await turn.stop();
    await expect.poll(async () => (await operator.state()).link).toContain('Connection lost');
    await turn.start();
    await operator.expectFrames(5);
    await operator.drives(0.1);
    expect((await operator.state()).sessionsOpened).toBe(1);
  } finally {
    await turn.stop();
  }
});
