/** Help in place, and the first drive. */
import { expectAccessible } from '../src/stage/accessibility.ts';
import { Devices } from '../src/stage/devices.ts';
import { expect, test } from '../src/stage/page-test.ts';

test('the help names the keys and buttons that count now, nothing drives while it is open, and ? closes it', async ({
  stage,
}) => {
  const devices = await Devices.install(stage.page);
  const keys = { keys: { forward: ['KeyI'] } };
  const page = await stage.open({ stored: { 'farpoint.inputs': keys } });
  const { keyboard } = page;
  await devices.plugIn('Pad (STANDARD GAMEPAD)', 'standard', [0, 0, 0, 0]);
  await keyboard.press('Slash');
  const help = page.getByRole('dialog', { name: 'Help' });
  await expect(help).toBeVisible();
  const row = (what: string) => help.locator('dl > div', { has: page.getByText(what, { exact: true }) });
  await expect(row('Forward')).toContainText('IPad: left stick ↕, right stick ↕');
  await expect(row('STOP')).toContainText('XF9Pad: B');
  await expect(row('Look around')).toContainText('drag the picture');
  await expectAccessible(stage, 'the help');

  // A hand on the keys or on a gamepad moves nothing, and drives afterwards only once it has opened the grip.
  await stage.forget();
  await keyboard.down('Space');
  await keyboard.down('KeyI');
  await devices.press(4, true);
  await devices.move(1, -1);
  await stage.run(500);
  expect((await stage.sent('command')).some(({ deadMan }) => deadMan)).toBe(false);
  await keyboard.up('KeyI');
  await keyboard.up('Space');
  // Typed as on a keyboard on which it is elsewhere.
  await page.evaluate(() =>
    document.body.dispatchEvent(new KeyboardEvent('keydown', { code: 'Minus', key: '?', bubbles: true })),
  );
  await expect(help).toBeHidden();
  await stage.run(500);
  expect((await stage.sent('command')).some(({ deadMan }) => deadMan)).toBe(false);

  // Where the keys are chosen, which closes the help.
  await devices.press(4, false);
  await page.locator('#help-open').click();
  await help.getByRole('button', { name: 'Inputs…' }).click();
  await expect(help).toBeHidden();
  await expect(page.getByRole('dialog', { name: 'Inputs' })).toBeVisible();
});

test('while a grip is held the help does not open, unless it is the Shift that types the question mark', async ({
  stage,
}) => {
  const page = await stage.open();
  const help = page.getByRole('dialog', { name: 'Help' });
  const { keyboard } = page;
  await keyboard.down('Space');
  await keyboard.down('KeyW');
  await stage.run(500);
  await keyboard.press('Slash');
  await expect(page.locator('#notice')).toHaveText('Let go of the grip first, then open the help.');
  await stage.run(200);
  await expect(help).toBeHidden();
  expect((await stage.sent('command')).at(-1)?.twist.linear.x).toBe(0.5);
  await keyboard.up('KeyW');
  await keyboard.up('Space');
  await keyboard.press('Shift+?');
  await expect(help).toBeVisible();
});

test('the first drive goes from step to step by what is done, takes no keys, and ends', async ({ stage }) => {
  const page = await stage.open();
  const { keyboard } = page;
  await page.locator('#help-open').click();
  await page.getByRole('button', { name: 'First drive' }).click();
  const tour = page.locator('#tour');
  const said = tour.getByRole('status');
  await tour.waitFor();
  await stage.run(300);
  await expect(said).toHaveText(/^Step 1 of 4: hold Space, Left Shift or Right Shift: this is the grip/);
  await expectAccessible(stage, 'the first drive');
  await keyboard.down('Space');
  await stage.run(500);
  await expect(said).toHaveText(/^Step 2 of 4: with the grip held, press W, A, S or D/);
  await keyboard.down('KeyW');
  await stage.run(600);
  await expect(said).toHaveText(/^Step 3 of 4: press X, or the STOP button/);
  await keyboard.press('KeyX');
  await keyboard.up('KeyW');
  await keyboard.up('Space');
  await stage.run(500);
  await expect(said).toHaveText(/^Step 4 of 4: hold R, or “Hold to release”/);
  expect((await stage.state()).estop).toBe(true);
  await keyboard.down('KeyR');
  await stage.run(1300);
  await keyboard.up('KeyR');
  await stage.run(300);
  await expect(said).toHaveText(/^That was all/);
  expect(await page.evaluate(() => localStorage.getItem('farpoint.tour'))).toBe('shown');
  await tour.getByRole('button', { name: 'Close' }).click();
  await expect(tour).toHaveCount(0);
});

test('the first drive comes by itself once this operator may drive, and once only; it says what keeps the robot from moving', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'stopped-at-robot', query: { tour: '1' } });
  const tour = page.locator('#tour');
  const said = tour.getByRole('status');
  await said.waitFor({ state: 'attached' });
  await stage.script(({ robot }) => {
    robot.stop({ latched: false, latch: 1 });
    robot.giveLease('other', 'Bo');
  });
  await stage.run(500);
  await expect(said).toHaveText(/^Step 1 of 4: Someone else is driving this robot/);
  await stage.script(({ robot }) => {
    robot.giveLease('nobody');
    robot.stop({ latched: true, by: 'robot', releasedAt: 'robot', latch: 1 });
  });
  await stage.run(500);
  await expect(said).toHaveText(/^Step 1 of 4: the emergency stop is on.*released there, at the robot/);
  await stage.script(({ robot }) => {
    robot.stop({ latched: false, latch: 1 });
    const motion = { factor: 0, reasons: ['obstacle'], mostLinear: 0.5, viewAgeMs: 50 };
    robot.telemetry = { motion } as never;
  });
  await stage.run(300);
  await page.keyboard.down('Space');
  await stage.run(700);
  await expect(said).toHaveText(/^Step 2 of 4: .*does not move now\. Held: something is in the way\.$/);
  await page.locator('#tour').getByRole('button', { name: 'Skip' }).click();
  await expect(said).toHaveText(/^Step 3 of 4/);
  await page.keyboard.up('Space');
  await tour.getByRole('button', { name: 'End' }).click();
  await expect(tour).toHaveCount(0);
  await stage.reload(1500);
  await expect(page.locator('#estop')).toBeVisible();
  await expect(tour).toHaveCount(0);
});
