/** People at one robot: who is here, how the drive goes from one to another, and who pressed STOP. */
import type { Page } from '@playwright/test';
import { expectNothingCovered } from '../src/stage/boxes.ts';
import { expect, test } from '../src/stage/page-test.ts';

const question = (page: Page) => page.getByRole('region', { name: 'Handing over the drive' });
const offerDialog = (page: Page) => page.getByRole('dialog', { name: 'Hand over the drive' });

test('the list says who is here, who drives and for how long, and who is away', async ({ stage }) => {
  const page = await stage.open({ state: 'own-request' });
  await stage.resize(1280, 720);
  await stage.run(1000);
  await expect(page.locator('#holder')).toHaveText('“Bo” is driving');
  await page.getByText('3 are here: “Bo” drives').click();
  const items = page.locator('#people-list li');
  await expect(items).toHaveText([
    '“Anna” (you, may drive)',
    '“Bo” (driving for less than 1 min)',
    '“Cy” (may drive, away: not heard from)',
  ]);
  // One request at a time.
  await expect(page.getByRole('button', { name: 'Ask to drive' })).toBeHidden();
  await stage.script(({ robot }) => {
    robot.people.answers(false);
    robot.people.drivesForS = 190;
    robot.people.list();
  });
  await stage.run(500);
  await expect(items.nth(1)).toHaveText('“Bo” (driving for 3 min)');
  await expect(page.getByRole('button', { name: 'Ask to drive' })).toBeVisible();
});

test('a robot without grants lists nobody but this operator: there is nothing to show', async ({ stage }) => {
  const page = await stage.open();
  await stage.script(({ robot }) => {
    robot.people.here = [{ number: 1, name: 'Anna', claimed: true, role: 'drive', you: true }];
    robot.giveLease('you');
  });
  await stage.run(300);
  await expect(page.locator('#people')).toBeHidden();
  await expect(page.locator('#release')).toHaveText('Give up the drive');
  await page.locator('#release').click();
  await stage.run(300);
  expect((await stage.state()).holder).toBe('nobody');
});

test('a question can be answered, and the drive handed over, on every screen, whatever the other is called', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'driving' });
  await stage.script(({ robot }) => {
    robot.people.here = [
      { number: 1, name: 'Anna', role: 'drive', you: true },
      { number: 2, name: 'W'.repeat(64), claimed: true, role: 'drive', you: false },
    ];
    robot.giveLease('you');
  });
  for (const [width, height] of [
    [360, 740],
    [667, 320],
    [640, 360],
    [427, 240],
    [320, 180],
  ] as const) {
    await stage.resize(width, height);
    await page.getByRole('button', { name: 'Hand over' }).click();
    await offerDialog(page)
      .getByRole('button', { name: /^Offer it to/ })
      .click({ trial: true });
    await offerDialog(page).getByRole('button', { name: 'Give it up' }).click({ trial: true });
    await page.locator('#estop').click({ trial: true });
    await offerDialog(page).getByRole('button', { name: 'Cancel' }).click();
    await stage.script(({ robot }) => robot.people.wants('ask', 'W'.repeat(64)));
    await stage.run(300);
    await expectNothingCovered(page, `a question on ${width} × ${height}`);
    await question(page).getByRole('button', { name: 'Give the drive' }).click({ trial: true });
    await question(page).getByRole('button', { name: 'Refuse' }).click();
    await stage.run(300);
    await expect(question(page)).toBeHidden();
  }
});

test('who asks is asked for by name, has seconds, and gets the drive; it reads as no takeover', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'driving' });
  await page.keyboard.down('Space');
  await stage.script(({ robot }) => {
    robot.people.here = [
      { number: 1, name: 'Anna', role: 'drive', you: true },
      { number: 2, name: 'Bo', role: 'drive', you: false },
    ];
    robot.giveLease('you');
    robot.people.wants('ask', 'Bo');
  });
  await stage.run(2000);
  await expect(question(page).getByRole('alert')).toHaveText('Bo asks to drive');
  await expect(page.locator('#handover-asked-left')).toHaveText(/^1[34] s$/);
  await question(page).getByRole('button', { name: 'Give the drive' }).click();
  await stage.run(1000);
  expect((await stage.sent('driveAnswer')).map(({ accept }) => accept)).toEqual([true]);
  await expect(question(page)).toBeHidden();
  await expect(page.locator('#holder')).toHaveText('Bo is driving');
  // The hand still holds on: it has agreed.
  await expect(page.locator('#banner')).toBeHidden();
  await expect(page.locator('#notice')).toHaveText('Bo drives now.');
});

test('points at the floor under the mouse, and sees where others point', async ({ stage }) => {
  const page = await stage.open({ state: 'people', canvas: '640x360' });
  const pointers = () =>
    stage.script(({ app }) => app.stage.pointers.shown.map(({ name, at }) => ({ name, at })));
  const canvas = (await page.locator('#stage').boundingBox())!;
  const below = { x: canvas.x + canvas.width / 2, y: canvas.y + canvas.height * 0.6 };
  await page.mouse.move(below.x, below.y);
  await page.keyboard.press('KeyG');
  await expect(page.locator('#notice')).toHaveText(
    'This robot does not show other operators where you point.',
  );
  await stage.tell({ type: 'pointing', may: true });
  await page.keyboard.press('KeyG');
  await stage.run(100);
  const [sent] = await stage.sent('point');
  // Ahead of the robot, on its floor.
  expect(sent?.at.x).toBeGreaterThan(0.5);
  expect(Math.abs(sent?.at.y ?? 9)).toBeLessThan(0.2);
  expect(await pointers()).toEqual([{ name: 'You', at: sent?.at }]);
  await stage.tell({ type: 'pointed', by: 2, at: { x: 3, y: 1, z: 0 } });
  await stage.run(100);
  expect(await pointers()).toContainEqual({ name: 'Bo', at: { x: 3, y: 1, z: 0 } });
  await stage.run(5000);
  expect(await pointers()).toEqual([]);
  // Above the horizon there is no floor. A click with Alt is the same as the key.
  await page.keyboard.down('Alt');
  await page.mouse.click(below.x, canvas.y + 80);
  await page.mouse.click(below.x, below.y);
  await page.keyboard.up('Alt');
  await stage.run(100);
  expect(await stage.sent('point')).toHaveLength(2);
});

test('a takeover in spite of an open request is told once it is certain', async ({ stage }) => {
  const page = await stage.open({ state: 'asked-to-drive' });
  await page.keyboard.down('Space');
  await stage.run(300);
  await stage.script(({ robot }) => robot.giveLease('other', 'Cy'));
  await stage.run(300);
  await expect(page.locator('#banner')).toBeHidden();
  await stage.script(({ robot }) => robot.people.interrupt('driver-changed'));
  await stage.run(300);
  await expect(page.locator('#banner')).toContainText('Cy has taken over and drives now.');
  await page.keyboard.up('Space');
  await stage.run(300);
  await expect(page.locator('#notice')).toHaveText('Cy has taken over and drives now. You do not.');
});

test('the driver offers the drive from the list or by Hand over, takes it back, and hears what becomes of it', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'asked-to-drive' });
  await stage.resize(1280, 720);
  const notice = page.locator('#notice');
  await question(page).getByRole('button', { name: 'Refuse' }).click();
  await stage.run(300);
  await expect(notice).toHaveText('Refused: the drive has not changed hands.');
  await page.getByText('3 are here: you drive').click();
  await page.locator('#people').getByRole('button', { name: 'Offer the drive to “Bo”' }).click();
  await stage.run(300);
  await expect(question(page).getByRole('status')).toHaveText('You have offered “Bo” the drive');
  await expect(page.locator('#people').getByRole('button', { name: /^Offer the drive/ })).toHaveCount(0);
  await question(page).getByRole('button', { name: 'Take back' }).click();
  await stage.run(300);
  await expect(notice).toHaveText('Your offer of the drive was taken back.');

  const offer = async () => {
    await page.getByRole('button', { name: 'Hand over' }).click();
    await offerDialog(page)
      .getByRole('button', { name: /^Offer it to “Bo”/ })
      .click();
    await stage.run(300);
    await expect(offerDialog(page)).toBeHidden();
  };
  await offer();
  await stage.script(({ robot }) => robot.people.answers(false));
  await stage.run(300);
  await expect(notice).toHaveText('“Bo” has refused: the drive has not changed hands.');
  await offer();
  await stage.run(15_000);
  await expect(notice).toHaveText('“Bo” did not answer: the drive has not changed hands.');
  await offer();
  await stage.script(({ robot }) => robot.people.answers(true));
  await stage.run(300);
  await expect(notice).toHaveText('“Bo” has accepted: “Bo” drives now.');
  await expect(page.locator('#banner')).toBeHidden();
});

test('Hand over lets the driver give the drive up, and the space bar offers it to nobody', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'driving' });
  await stage.script(({ robot }) => {
    robot.people.here = [
      { number: 1, name: 'Anna', role: 'drive', you: true },
      { number: 2, name: 'Bo', role: 'drive', you: false },
    ];
    robot.giveLease('you');
  });
  await stage.run(300);
  await page.getByRole('button', { name: 'Hand over' }).click();
  await page.keyboard.press('Space');
  await stage.run(300);
  expect(await stage.sent('driveOffer')).toEqual([]);
  await offerDialog(page).getByRole('button', { name: 'Cancel' }).click();
  expect((await stage.state()).holder).toBe('you');
  await page.getByRole('button', { name: 'Hand over' }).click();
  await offerDialog(page).getByRole('button', { name: 'Give it up' }).click();
  await stage.run(300);
  expect((await stage.state()).holder).toBe('nobody');
});

test('whoever accepts an offer with the grip held must open it first', async ({ stage }) => {
  const page = await stage.open({ state: 'offered-the-drive' });
  await expect(question(page).getByRole('alert')).toHaveText('“Bo” offers you the drive');
  await page.keyboard.down('Space');
  await page.keyboard.down('KeyW');
  await stage.run(300);
  await question(page).getByRole('button', { name: 'Take the drive' }).click();
  await stage.forget();
  await stage.run(1000);
  expect(await stage.state()).toMatchObject({ holder: 'you', gripLost: 'other-drives' });
  await expect(page.locator('#banner')).toContainText('Let go of the grip');
  expect((await stage.sent('command')).filter(({ deadMan }) => deadMan)).toEqual([]);
  await page.keyboard.up('KeyW');
  await page.keyboard.up('Space');
  await stage.run(300);
  await expect(page.locator('#banner')).toBeHidden();
  await expect(page.locator('#notice')).toHaveText(
    'You drive now, by “Bo”’s offer. Press the grip anew to drive.',
  );
});

test('an own request ends with STOP, which is told by name once, as is its release', async ({ stage }) => {
  const page = await stage.open({ state: 'own-request' });
  const notice = page.locator('#notice');
  await expect(question(page).getByRole('status')).toHaveText('You have asked “Bo” for the drive');
  const press = () =>
    stage.script(({ robot }) =>
      robot.stop({ latched: true, by: 'operator', latch: 1 }, { pressedBy: 'Bo', yours: false }),
    );
  await press();
  await stage.run(300);
  await expect(notice).toHaveText('Your request for the drive has ended: “Bo” pressed STOP.');
  await expect(question(page)).toBeHidden();
  await stage.script(({ robot }) => robot.stop({ latched: false }));
  await stage.run(300);
  await expect(notice).toHaveText('“Bo” has released the emergency stop.');
  await press();
  await stage.run(300);
  await expect(notice).toHaveText('“Bo” has pressed STOP.');
  await stage.run(6000);
  await press();
  await stage.run(300);
  await expect(notice).toBeHidden();
});

test('an own STOP and its own release are no news', async ({ stage }) => {
  const page = await stage.open({ state: 'asked-to-drive' });
  await question(page).getByRole('button', { name: 'Refuse' }).click();
  await stage.run(6000);
  await page.getByRole('button', { name: 'STOP' }).click();
  await stage.run(300);
  await expect(page.locator('#notice')).toBeHidden();
  await page.keyboard.down('KeyR');
  await stage.run(1300);
  await page.keyboard.up('KeyR');
  expect((await stage.state()).estop).toBe(false);
  await expect(page.locator('#notice')).toBeHidden();
});
