/** How long outages last, and what they leave, is asked in virtual time: packages/scenario. */
import { EmulatedLink } from '@farpoint/local-stack';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

const linkArgs = ['--rate-mbps', '20', '--rtt-ms', '30'];
const robotArgs = [...simulatedRobot.args, '--bitrate-mbps', '6'];

/**
 * After the outage: the session is the same, the robot stands although the keys are held, and drives when they are
 * pressed again.
 */
async function expectDriveAgain(operator: OperatorPage): Promise<void> {
  await operator.expectStanding();
  const stood = await operator.body();
  // No path but the new one brings frames.
  await operator.expectFrames(5);
  expect(await operator.state()).toMatchObject({ session: 'live', sessionsOpened: 1, driving: false });
  const stands = await operator.body();
  expect(Math.hypot(stands.x - stood.x, stands.y - stood.y)).toBeLessThan(0.01);
  await operator.release();
  await operator.holdForward();
  await operator.expectMovedFrom(stands, 0.05);
  await operator.release();
  await operator.expectStanding();
}

test('all addresses change: ICE restarts with new ones, in the same session', async ({
  page,
  startStack,
}) => {
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, { args: linkArgs });
  try {
    await stack.startRobot({
      ...simulatedRobot,
      args: [...robotArgs, '--signaling', link.signalingUrl],
    });
    const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
    await operator.expectPoints();
    const start = await operator.body();
    await operator.holdForward();
    await operator.expectMovedFrom(start, 0.2);

    await link.renumber();
    await expectDriveAgain(operator);
  } finally {
    await link.stop();
  }
});
