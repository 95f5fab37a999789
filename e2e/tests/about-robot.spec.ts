/** What must be known of a robot before it is used: that it plays files, has no wheels, or records. */

import { writeGreyPcd } from '../src/grey-pcd.ts';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

test('a playback without wheels is marked as one, and offers no driving', async ({
  page,
  startStack,
}, testInfo) => {
  const path = testInfo.outputPath('wall.pcd');
  writeGreyPcd(
    path,
    Array.from({ length: 400 }, (_, i) => [2, (i % 20) / 10 - 1, Math.floor(i / 20) / 10] as const),
    128,
  );
  const robot = { id: 'played', name: 'A wall', args: ['--source', 'pcd', '--path', path] };
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id, tour: '1' });
  await operator.expectPoints(100);
  const about = page.locator('#about');
  await expect(about).toHaveText('Playback: nothing that you see is there now');
  await expect(page.locator('#holder')).toHaveText('Nothing to drive: this robot has no wheels');
  await page.setViewportSize({ width: 1280, height: 720 });
  for (const id of ['joystick', 'drive-hint', 'take', 'release', 'tour'])
    await expect(page.locator(`#${id}`)).toBeHidden();
  // A key that would drive asks for no grip.
  await page.keyboard.down('w');
  await operator.expectFrames(10);
  await page.keyboard.up('w');
  await expect(page.locator('#notice')).not.toContainText('Hold Space');
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await operator.look(testInfo, `playback-${size.width}`);
    await expectOnScreenAndApart(page.locator('#bar button:visible, #about, #facts, #estop'), size);
  }
});

test('a session that is recorded says so, until the recording ends', async ({
  page,
  startStack,
}, testInfo) => {
  const file = testInfo.outputPath('session.mcap');
  const args = [...lightRobot.args, '--record', file, '--record-max', '2MB'];
  const stack = await startStack({ robots: [{ ...lightRobot, args }] });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
  await operator.expectPoints(100);
  const about = page.locator('#about');
  await expect(about).toHaveText('This session is being recorded');
  await operator.look(testInfo, 'recorded');
  // It is driven as ever. The keys are named where there is room.
  await page.setViewportSize({ width: 1280, height: 720 });
  await expect(page.locator('#joystick, #drive-hint').filter({ visible: true })).toHaveCount(1);
  // The file is full after a while.
  await expect(about).toBeHidden({ timeout: 90_000 });
});
