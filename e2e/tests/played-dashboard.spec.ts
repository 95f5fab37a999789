import { OperatorPage } from '../src/operator-page.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

test('the dashboard shows the quantities, alarms and diagnostics of a recording, marked as recorded', async ({
  page,
  startStack,
}, testInfo) => {
  await page.setViewportSize({ width: 1280, height: 720 });
  const path = testInfo.outputPath('drive.mcap');
  const light = ['--mode', 'points64', '--max-points', '4000', '--fps', '15'];
  const recorded = { ...simulatedRobot, args: [...light, '--sim-charge', '15', '--record', path] };
  const recording = await startStack({ robots: [recorded] });
  const driven = await OperatorPage.open(page, recording, { robot: recorded.id });
  await driven.expectPoints();
  await expect(page.locator('#alarm')).toHaveText(
    '⚠ The battery is low: drive to the charger (15 %, limit 20 %)',
  );
  await driven.expectFrames(60);
  await recording.stop();

  const played = {
    id: 'played-1',
    name: 'Played',
    args: [...light, '--source', 'recording', '--path', path],
  };
  const stack = await startStack({ robots: [played] });
  const operator = await OperatorPage.open(page, stack, { robot: played.id });
  await operator.expectPoints();
  await expect(page.locator('#alarm')).toHaveText(
    '⚠ Recorded: The battery is low: drive to the charger (15 %, limit 20 %)',
  );
  await page.keyboard.press('KeyB');
  const dashboard = page.locator('#dashboard');
  const tile = (name: string) => dashboard.getByRole('region', { name, exact: true });
  await expect(dashboard.locator('.state')).toHaveText(/^In step with the picture, \d+ ms old$/);
  await expect(tile('Diagnostics').locator('.counts')).toHaveText('1 warning, 3 OK (recorded)');
  const curve = tile('Left motor (recorded), °C');
  await curve.scrollIntoViewIfNeeded();
  await expect(curve.locator('.now')).toContainText(/^2[2-9]\.\d °C$/);
  await operator.look(testInfo, 'played');
});
