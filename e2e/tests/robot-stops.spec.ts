import { expectOnScreenAndApart } from '../src/layout.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

test('a stop at the robot itself is released there only, and the page says so', async ({
  page,
  startStack,
}) => {
  const stack = await startStack({
    robots: [{ ...lightRobot, args: [...lightRobot.args, '--stop-key'], input: true }],
  });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
  await operator.expectPoints(100);
  const release = page.locator('#estop-release');
  await page.keyboard.down('Space');
  await operator.expectState('holder', 'you');
  await page.keyboard.up('Space');

  stack.robot(lightRobot.id).type(' ');
  await expect(release).toBeVisible();
  await expect(release).toBeDisabled();
  await expect(release).toHaveText(/^\s*Release at robot\s*a stop there is on\s*$/, { useInnerText: true });
  await expect(page.locator('#facts')).toContainText('released at the robot only');
  await expect(page.locator('#facts')).toContainText('Stop (console)');
  const screen = { width: 360, height: 740 };
  await page.setViewportSize(screen);
  await expectOnScreenAndApart(page.locator('#bar button:visible, #drive button:visible'), screen);
  await page.setViewportSize({ width: 1280, height: 800 });
  // Held for longer than a release takes, the key does nothing.
  await page.keyboard.down('KeyR');
  await operator.expectFrames(20);
  await page.keyboard.up('KeyR');
  await expect(release).toBeDisabled();

  // The operator's own STOP remains once the robot's side has let go.
  await page.locator('#estop').click();
  await expect(page.locator('#stop-state')).toHaveText(/confirmed/);
  stack.robot(lightRobot.id).type('release\n');
  await expect(release).toBeEnabled();
  await expect(release).toHaveText(/Hold to release/);
  await page.keyboard.down('KeyR');
  await expect(release).toBeHidden();
  await page.keyboard.up('KeyR');
});
