/** Who may do what, and who the robot is, as the page says it. */
import { expect, test } from '../src/stage/page-test.ts';

const THUMBPRINT = 'A'.repeat(43);

test('who drives is said by name, and a watcher is offered nothing that it may not do', async ({ stage }) => {
  const page = await stage.open({ state: 'watching' });
  await expect(page.locator('#holder')).toHaveText('Nobody is driving. Your grant lets you watch');
  // It asks for nothing and commands nothing, also while nobody drives.
  await page.keyboard.down('Space');
  await page.keyboard.down('KeyW');
  await stage.run(1000);
  await page.keyboard.up('KeyW');
  await page.keyboard.up('Space');
  expect(await stage.sent('leaseRequest')).toEqual([]);
  expect((await stage.sent('command')).filter(({ deadMan }) => deadMan)).toEqual([]);
  await stage.script(({ robot }) => robot.giveLease('other', 'Grace Hopper'));
  await stage.run(300);
  await expect(page.locator('#holder')).toHaveText('Grace Hopper is driving');
  await expect(page.getByRole('button', { name: 'Take over' })).toBeHidden();
  await expect(page.getByLabel('Drive: hold and move')).toBeHidden();
  // Everybody may stop the robot.
  await page.getByRole('button', { name: 'STOP' }).click();
  await stage.run(300);
  expect((await stage.state()).estop).toBe(true);
});

test('whoever may drive can take over, once, from somebody else', async ({ stage }) => {
  const page = await stage.open({ state: 'other-drives' });
  await expect(page.locator('#holder')).toHaveText('Bo is driving');
  // A grip alone takes nothing from anybody.
  await page.keyboard.down('Space');
  await stage.run(1000);
  await page.keyboard.up('Space');
  expect((await stage.sent('leaseRequest')).filter(({ take }) => take)).toEqual([]);
  expect((await stage.state()).holder).toBe('other');
  await page.getByRole('button', { name: 'Take over' }).click();
  await stage.run(300);
  expect((await stage.sent('leaseRequest')).filter(({ take }) => take)).toHaveLength(1);
  await expect(page.locator('#holder')).toHaveText('You have control');
  await page.getByRole('button', { name: 'Hand over' }).click();
  await stage.run(300);
  expect((await stage.state()).holder).toBe('nobody');
});

test('without a grant the page says what to do, and asks nobody again by itself', async ({ stage }) => {
  const page = await stage.open({ state: 'blank' });
  await stage.script((stage) => {
    const { robot, link } = stage;
    robot.onRequest = () => link.end('not-granted');
    robot.appear(link);
    stage.app.choose(robot.id);
  });
  await stage.run(300);
  const obstacle = page.getByRole('alertdialog');
  await expect(obstacle).toContainText('admits only operators with a grant');
  await stage.script(({ robot }) => {
    robot.onRequest = () => {
      throw new Error('the page has asked again');
    };
  });
  await stage.run(60_000);
  expect((await stage.state()).session).toBe('waiting');
  await obstacle.getByRole('button', { name: 'Grants…' }).click();
  const dialog = page.getByRole('dialog', { name: 'Grants' });
  // WebCrypto makes it while nobody waits.
  await expect(dialog.getByLabel('This browser’s key')).toHaveValue(/^[\w-]{43}$/);
  await dialog.getByLabel('Grant or ticket').fill('not a grant');
  await expect(dialog.getByText('neither a grant nor a ticket')).toBeVisible();
  await expect(dialog.getByRole('button', { name: 'Add grant' })).toBeDisabled();
});

test('a robot with another key is not taken for the one that this browser knows', async ({ stage }) => {
  const page = await stage.open({ state: 'blank' });
  await stage.script((stage, thumbprint) => {
    const { robot, link } = stage;
    const changed = { robotId: robot.id, known: 'B'.repeat(43), shown: thumbprint, byGrant: false };
    const admit = robot.onRequest.bind(robot);
    robot.onRequest = () => {
      robot.onRequest = admit;
      link.fail('robot-key-changed', changed);
    };
    robot.appear(link);
    stage.app.choose(robot.id);
  }, THUMBPRINT);
  await stage.run(10_000);
  const obstacle = page.getByRole('alertdialog');
  await expect(obstacle).toContainText('This may be another robot');
  await expect(page.locator('#obstacle-shown')).toHaveText(THUMBPRINT);
  expect((await stage.state()).session).toBe('waiting');
  await obstacle.getByRole('button', { name: 'Trust the new key' }).click();
  await stage.run(500);
  expect((await stage.state()).session).toBe('live');
  await expect(obstacle).toBeHidden();
});

test('a supervisor sees who is here, and ends a driver’s session', async ({ stage }) => {
  const page = await stage.open({ state: 'people' });
  await page.getByText('3 are here: Bo drives').click();
  await expect(page.getByText('Anna (you, supervisor)')).toBeVisible();
  await page.getByRole('button', { name: 'End the session of Bo…' }).click();
  const confirm = page.getByRole('dialog', { name: 'End the session of Bo?' });
  await confirm.getByLabel('Also refuse this operator’s grant').check();
  await confirm.getByRole('button', { name: 'Cancel' }).click();
  await stage.run(300);
  expect(await stage.sent('endSession')).toEqual([]);
  await page.getByRole('button', { name: 'End the session of Bo…' }).click();
  await confirm.getByLabel('Also refuse this operator’s grant').check();
  await confirm.getByRole('button', { name: 'End session' }).click();
  await stage.run(300);
  expect(await stage.sent('endSession')).toEqual([{ type: 'endSession', operator: 2, block: true }]);
});

test('a driver whose session a supervisor has ended is told by whom, and does not come back by itself', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'driving' });
  await stage.script(({ link }) => link.end('ended-by-supervisor', 'Sue ended the session'));
  await stage.run(20_000);
  expect((await stage.state()).notice).toContain('Sue ended the session');
  expect(await stage.state()).toMatchObject({ session: 'none', sessionsOpened: 1 });
  await expect(page.getByRole('button', { name: /Robot on a stage/ })).toBeVisible();
});
