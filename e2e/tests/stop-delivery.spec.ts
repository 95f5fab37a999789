import { EmulatedLink } from '@farpoint/local-stack';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

const NOT_YET = 'STOP not yet confirmed';
const robotArgs = [...simulatedRobot.args, '--bitrate-mbps', '6'];

test('STOP that is pressed while the network is away stops the robot at its return, and the page says both', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, { args: ['--rate-mbps', '20', '--rtt-ms', '30'] });
  try {
    await stack.startRobot({ ...simulatedRobot, args: [...robotArgs, '--signaling', link.signalingUrl] });
    const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
    await operator.expectPoints();
    const state = page.locator('#stop-state');
    await expect(state).toBeHidden();

    link.tell({ type: 'blackhole', direction: 'both', active: true });
    await expect(page.getByText(/Connection lost for \d+ s/).first()).toBeVisible();
    await page.locator('#estop').click();
    await expect(state).toHaveText(NOT_YET);
    for (const width of [360, 3840, 1280]) {
      await page.setViewportSize({ width, height: width === 360 ? 740 : Math.round(width * 0.5625) });
      await expect(state).toBeInViewport({ ratio: 1 });
      await operator.look(testInfo, `not-confirmed-${width}`);
    }
    link.tell({ type: 'blackhole', direction: 'both', active: false });
    await expect(state).toHaveText('STOP confirmed');
    await operator.expectState('estop', true);

    // A press on a path that holds is confirmed as well, and what is released is no longer spoken of.
    await operator.releaseEstop();
    await expect(state).toBeHidden();
    await page.locator('#estop').click();
    await expect(state).toHaveText('STOP confirmed');
    await operator.releaseEstop();
    await operator.expectState('drive', 'idle');
  } finally {
    await link.stop();
  }
});
