import { writeFileSync } from 'node:fs';
import { EmulatedLink } from '@farpoint/local-stack';
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

const ALARMS = [
  { of: 'charge', low: { warn: 30, error: 20 }, hysteresis: 2, text: 'The battery is low' },
  { of: 'speed', high: { warn: 0.2 }, hysteresis: 0.05, text: 'The robot is fast' },
];
const LOW = '⚠ The battery is low (15 %, limit 20 %)';

test.use({ viewport: headsetViewport });

test('in the headset: an alarm is on the wrist, and is of the past when the robot is not heard', async ({
  page,
  startStack,
}, testInfo) => {
  const config = testInfo.outputPath('farpoint.yaml');
  // JSON is valid YAML.
  writeFileSync(config, JSON.stringify({ robot: { alarms: ALARMS } }));
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, { args: ['--rate-mbps', '20', '--rtt-ms', '30'] });
  try {
    const args = ['--bitrate-mbps', '4', '--sim-charge', '15', '--config', config];
    await stack.startRobot({
      ...lightRobot,
      args: [...lightRobot.args, ...args, '--signaling', link.signalingUrl],
    });
    const headset = await Headset.wear(page);
    const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
    await operator.expectPoints(300);
    expect(await page.evaluate(() => window.farpoint.wrist())).toBeNull();
    await enterVr(page, operator);
    await headset.place('left', [-0.05, 1.55, -0.35]);
    const alarms = () =>
      page.evaluate(() => (window.farpoint.wrist() ?? []).filter(({ text }) => text.startsWith('⚠')));
    await expect.poll(alarms).toEqual([{ text: LOW, tone: 'bad' }]);
    await operator.expectFrames(5);
    await operator.look(testInfo, 'wrist-alarm');

    // A second one is counted, and is not the first: it is only a warning.
    const start = await operator.body();
    await operator.hold(headset.grip('right'));
    await headset.thumbstick('right', 0, -1);
    await operator.expectMovedFrom(start, 0.3);
    await expect.poll(alarms).toEqual([{ text: `${LOW} (and 1 more)`, tone: 'bad' }]);
    await headset.thumbstick('right', 0, 0);
    await operator.release();
    await operator.expectStanding();
    await expect.poll(alarms).toEqual([{ text: LOW, tone: 'bad' }]);

    link.tell({ type: 'blackhole', direction: 'both', active: true });
    await expect
      .poll(async () => (await alarms()).map(({ text }) => text.replace(/\d+ s ago/, 'N s ago')))
      .toEqual([`${LOW}, N s ago`]);
    await operator.look(testInfo, 'wrist-alarm-stale');
    link.tell({ type: 'blackhole', direction: 'both', active: false });
    await expect.poll(alarms).toEqual([{ text: LOW, tone: 'bad' }]);
  } finally {
    await link.stop();
  }
});
