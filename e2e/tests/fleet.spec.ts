/** The list of robots: what each does without a session, found, sorted, and chosen. */
import { expectAccessible } from '../src/accessibility.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

const fleet = ['Rover', 'Mule', 'Scout', 'Digger'].map((name, i) => ({
  id: `sim-${i + 1}`,
  name,
  args: [
    ...[...lightRobot.args, '--list-status', i === 0 ? 'names' : i === 3 ? 'off' : 'state'],
    ...(i === 2 ? ['--sim-charge', '15'] : []),
  ],
}));

test('the list says what each robot does, is searched and sorted, and leads to one', async ({
  page,
  context,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: fleet });
  const operator = await OperatorPage.open(page, stack);
  const item = (name: string) => page.locator('#robot-list').getByRole('button', { name });
  const names = () => page.locator('#robot-list button > span:first-child').allTextContents();
  await expect(item('Rover')).toContainText('Nobody drives');
  await expect(item('Scout')).toContainText(/battery 1\d %/);
  await expect(item('Mule')).toContainText('0 of 4 here');
  // It says nothing of itself.
  await expect(item('Digger').locator('.status')).toHaveCount(0);
  expect(await names()).toEqual(['Digger', 'Mule', 'Rover', 'Scout']);

  const adasPage = await context.newPage();
  const ada = await OperatorPage.open(adasPage, stack, { robot: 'sim-1', canvas: '64x36', name: 'Ada' });
  await ada.expectPoints(100);
  await ada.holdForward();
  await expect(item('Rover')).toContainText('Ada drives');
  await expect(item('Rover')).toContainText('1 of 4 here');
  const said = async () => {
    await ada.gripAnew();
    return item('Rover').textContent();
  };
  await expect.poll(said).toContain('moving');
  await ada.releaseKeys();
  await adasPage.keyboard.press('KeyX');
  await expect(item('Rover')).toContainText('STOP is on');
  await page.bringToFront();
  await page.getByLabel('Order').selectOption('Needs attention first');
  expect((await names())[0]).toBe('Rover');
  expect((await names())[1]).toBe('Scout');
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await expect(page.locator('#robots')).toBeInViewport({ ratio: 1 });
    await operator.look(testInfo, `fleet-${size.width}`);
  }
  await page.setViewportSize({ width: 1280, height: 720 });
  await expectAccessible(page, 'fleet');
  await page.getByLabel('Find a robot by name or id').fill('ule');
  await expect(page.locator('#robots-found')).toHaveText('1 of 4 robots');
  expect(await names()).toEqual(['Mule']);

  // A robot that is gone, and one that says something new, are so at once.
  await page.getByLabel('Find a robot by name or id').fill('');
  await stack.robot('sim-3').kill();
  await expect(item('Scout')).toHaveCount(0);
  await adasPage.close();
  await expect(item('Rover')).toContainText('Nobody drives');
  await item('Mule').click();
  await operator.expectPoints(100);
  // What it showed last is in the list, small, when one is back there.
  await expect.poll(async () => (await operator.stats()).framesDrawn).toBeGreaterThan(80);
  await page.getByRole('button', { name: 'Disconnect' }).click();
  await expect(item('Mule').locator('canvas')).toBeVisible();
  await expect(item('Mule')).toContainText('seen here just now');
  await expect(item('Rover').locator('canvas')).toHaveCount(0);
  await operator.look(testInfo, 'seen');
});
