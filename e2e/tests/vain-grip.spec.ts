/** A hand on the controls that moves nothing is told why, and what to do. */
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

test('a key without the grip: the page says what to hold, and says it politely', async ({
  page,
  startStack,
}) => {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id, canvas: '64x36' });
  await operator.expectPoints(100);
  const notice = page.locator('#notice');
  await page.keyboard.down('w');
  await expect(notice).toHaveText('Hold Space, too: the robot moves only while you do.');
  await expect(notice).toHaveRole('status');
  await operator.expectState('holder', 'nobody');
  await page.keyboard.up('w');
  // With the grip there is nothing to say.
  await expect(notice).toBeHidden({ timeout: 15_000 });
  await operator.holdForward();
  await operator.expectState('holder', 'you');
  await operator.expectFrames(10);
  await expect(notice.filter({ visible: true, hasText: 'Hold Space' })).toHaveCount(0);
  await operator.releaseKeys();
});

test('a takeover is told to who drove, for as long as the hand holds on', async ({
  page,
  context,
  startStack,
}, testInfo) => {
  const args = [...lightRobot.args, '--take-policy', 'always'];
  const stack = await startStack({ robots: [{ ...lightRobot, args }] });
  const options = { robot: lightRobot.id, canvas: '64x36' };
  const ada = await OperatorPage.open(page, stack, options);
  await ada.expectPoints(100);
  const othersPage = await context.newPage();
  const other = await OperatorPage.open(othersPage, stack, options);
  await other.expectPoints(100);
  await page.bringToFront();
  await page.keyboard.down('Space');
  await ada.expectState('holder', 'you');
  await other.expectState('holder', 'other');

  // By hand, the other page would come to the front, and this one would lose its keys.
  await othersPage.getByRole('button', { name: 'Take over' }).dispatchEvent('click');
  await ada.expectState('holder', 'other');
  const banner = page.locator('#banner');
  await expect(banner).toHaveText(/^Taken over.*has taken over and drives now.*Let go of the grip\.$/);
  await expect(banner).toHaveRole('status');
  await ada.screenshots(page, testInfo, 'taken-over');
  await page.keyboard.up('Space');
  await expect(banner).toBeHidden();

  // Without a hand on the controls it is a notice that goes by itself.
  await page.getByRole('button', { name: 'Take over' }).click();
  await ada.expectState('holder', 'you');
  await othersPage.getByRole('button', { name: 'Take over' }).dispatchEvent('click');
  await expect(page.locator('#notice')).toHaveText(/has taken over and drives now\. You do not\.$/);
  await expect(banner).toBeHidden();
});

test('a grip that was held while the link was away: the page asks to let go of it', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id, canvas: '64x36' });
  await operator.expectPoints(100);
  await page.keyboard.down('Space');
  await operator.expectState('holder', 'you');
  const banner = page.locator('#banner');
  stack.robot(lightRobot.id).signal('SIGSTOP');
  await expect(banner).toContainText('Connection lost');
  await expect(banner).toHaveRole('alert');
  await expect.poll(async () => (await operator.state()).gripLost).not.toBeNull();
  stack.robot(lightRobot.id).signal('SIGCONT');
  await expect(banner).toHaveText(/^Let go of the grip.*Let go of it, then drive\.$/);
  await expect(banner).toHaveRole('status');
  await operator.look(testInfo, 'let-go-first');
  await page.keyboard.up('Space');
  await expect(banner).toBeHidden();
});
