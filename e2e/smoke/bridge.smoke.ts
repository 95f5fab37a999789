import { BridgeProcess } from '@farpoint/local-stack';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, test } from '../src/smoke-test.ts';
import { WatchingOperator } from '../src/watching-operator.ts';

test('through the bridge: see, drive, stop and measure, beside a Farpoint operator; and again after it was away', async ({
  page,
  shared,
}) => {
  const { id, name } = await shared.bridged();
  const { stack } = shared;
  const watcher = await WatchingOperator.open(stack, id);
  let bridge = await BridgeProcess.start(stack);
  try {
    const operator = await OperatorPage.open(page, stack.webUrl, { bridge: bridge.address });
    await page.getByRole('button', { name }).click();
    await operator.expectPoints();
    await operator.drives(0.1, { watcher });
    await operator.expectState('holder', 'you');
    expect(watcher.holder).toBe('other');

    // The page's own stop.
    await page.keyboard.press('KeyX');
    await operator.expectState('estop', true);
    await operator.cannotDrive(watcher);
    await operator.releaseEstop();
    await operator.drives(0.05, { watcher });

    const result = await page.evaluate(() => window.farpoint.latencyTest());
    expect(result.points).toBe(result.totalPoints);

    const { ports } = bridge;
    await bridge.process.kill();
    await operator.expectState('session', 'waiting');
    bridge = await BridgeProcess.start(stack, { ports });
    await operator.expectPoints();
  } finally {
    await bridge.stop();
    await watcher.close();
  }
});
