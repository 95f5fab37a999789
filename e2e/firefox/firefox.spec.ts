/**
 * The operator's page in an unmodified Firefox, which hides its addresses behind mDNS names and trickles TCP
 * candidates.
 */
import { expect, test } from '../src/firefox-test.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { lightRobot, simulatedRobot } from '../src/stack-test.ts';

const CONNECTIONS = 10;
/** Connecting must be this fast. Waiting for a single mDNS look-up would take ten seconds. */
const MOST_SECONDS = 5;

/** The whole of the camera's view, at a rate that a software renderer can follow. */
const wholeRobot = {
  id: 'whole',
  name: 'Whole cloud',
  args: ['--source', 'sim', '--sim-seed', '1', '--fps', '8', '--start-mbps', '20', '--bitrate-mbps', '30'],
};

test(`connects ${CONNECTIONS} times in a row`, async ({ firefoxPage, startStack }) => {
  const stack = await startStack();
  const operator = await OperatorPage.open(firefoxPage, stack);
  await operator.expectState('signaling', 'ready');
  const seconds: number[] = [];
  for (let count = 0; count < CONNECTIONS; count++) {
    seconds.push(
      await firefoxPage.evaluate(async (robot) => {
        const began = performance.now();
        await window.farpoint.connect(robot, 30_000);
        const took = (performance.now() - began) / 1000;
        window.farpoint.disconnect();
        return took;
      }, simulatedRobot.id),
    );
    await operator.expectState('session', 'none');
  }
  console.log(`seconds to the first points: ${seconds.map((one) => one.toFixed(2)).join(' ')}`);
  expect(Math.max(...seconds)).toBeLessThan(MOST_SECONDS);
});

test('sees the whole cloud', async ({ firefoxPage, startStack }, testInfo) => {
  const stack = await startStack({ robots: [wholeRobot] });
  const operator = await OperatorPage.open(firefoxPage, stack, {
    robot: wholeRobot.id,
    canvas: '320x180',
    every: '1',
  });
  await operator.expectPoints(10_000);
  // 480 × 480 pixels, about 15 % of which a stereo camera cannot see.
  await expect.poll(async () => (await operator.stats()).pointsPerFrame).toBeGreaterThan(170_000);
  // A busy machine's decoder falls behind.
  const { 'no-stream': _, 'decoder-behind': __, ...drops } = (await operator.stats()).drops;
  expect(drops).toEqual({});
  await operator.look(testInfo, 'firefox-whole-cloud');
});

// Light: what a software renderer shows late of a whole cloud slows and stops the robot, as it should.
test('drives, and stops immediately', async ({ firefoxPage, startStack }) => {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(firefoxPage, stack, { robot: lightRobot.id, canvas: '320x180' });
  await operator.expectPoints(300);
  const start = await operator.body();
  await operator.holdForward();
  await operator.expectState('holder', 'you');
  await operator.expectMovedFrom(start, 0.3);
  // Stop while the keys are still held.
  await firefoxPage.keyboard.press('x');
  await operator.expectState('estop', true);
  await operator.expectStanding();
  const stopped = await operator.body();
  await operator.expectFrames(5);
  expect(await operator.body()).toEqual(stopped);
  await operator.releaseKeys();
});
