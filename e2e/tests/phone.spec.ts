import { expectOnScreenAndApart } from '../src/layout.ts';
import { expect, test } from '../src/stack-test.ts';

test.use({ viewport: { width: 360, height: 740 }, hasTouch: true });

test('on a phone held upright every control is on the screen and none covers another', async ({
  page,
  openRobot,
}, testInfo) => {
  const { operator } = await openRobot();
  await operator.look(testInfo, 'phone');
  const controls = page.locator(
    '#bar button:visible, #bar select:visible, #bar #link, #drive button:visible, #joystick',
  );
  await expect(page.getByRole('button', { name: 'Disconnect' })).toBeVisible();
  await expect(page.getByRole('button', { name: 'Settings' })).toBeVisible();
  // The text about the link is not truncated.
  expect(await page.locator('#link').evaluate((link) => link.scrollWidth - link.clientWidth)).toBe(0);
  expect((await expectOnScreenAndApart(controls, { width: 360, height: 740 })).length).toBeGreaterThan(5);
  await page.getByRole('button', { name: 'Disconnect' }).tap();
  await expect(page.getByRole('button', { name: /Simulated robot 1/ })).toBeVisible();
});
