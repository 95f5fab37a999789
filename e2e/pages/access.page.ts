/** Who may do what, and who the robot is, as the page says it. */
import { admit, endedGrantFor, grantFor, grantsDialog, storedKey, ticketFor } from '../src/stage/grants.ts';
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
  await page.getByRole('button', { name: 'Give up the drive' }).click();
  await stage.run(300);
  expect((await stage.state()).holder).toBe('nobody');
});

test('without a grant the page says what to do, and asks again once it has one; key and grant outlive the page', async ({
  stage,
}) => {
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
  // No wait between two attempts is longer than 6.25 s.
  await stage.run(7000);
  expect((await stage.state()).session).toBe('waiting');
  await obstacle.getByRole('button', { name: 'Grants…' }).click();
  const { own, text, read, add, held } = grantsDialog(page);
  // WebCrypto makes it while nobody waits.
  await expect(own).toHaveValue(/^[\w-]{43}$/);
  const forKey = await own.inputValue();
  const ticket = await ticketFor({});
  for (const [refused, words] of [
    ['not a grant', 'This is neither a grant nor a ticket. Paste the whole line.'],
    [await grantFor(THUMBPRINT), 'This grant was made for another key than this browser’s.'],
    [await endedGrantFor(forKey), 'This grant has ended. Ask for another.'],
    [ticket.slice(0, -40), 'This ticket is damaged. Paste the whole line, or ask for another.'],
  ] as const) {
    await text.fill(refused);
    await expect(read).toHaveText(words);
    await expect(add).toBeDisabled();
  }
  await text.fill(await grantFor(forKey));
  await expect(read).toHaveText(/^Ada Lovelace may drive: \*, until /);
  await expect(held).toHaveCount(0);
  expect(await storedKey(page)).toEqual({ extractable: false, grants: 0 });
  await stage.run(300);

  await stage.script(admit, { role: 'drive', name: 'Ada Lovelace', expiresInS: 3600 } as const);
  await add.click();
  await expect(read).toHaveText('Added.');
  await expect(held).toHaveText(/^Ada Lovelace may drive: \*, until /);
  await expect(add).toBeDisabled();
  await stage.run(500);
  expect((await stage.state()).session).toBe('live');
  await expect(obstacle).toBeHidden();

  // No script can read the key; it and the grant are there at the next visit.
  expect(await storedKey(page)).toEqual({ extractable: false, grants: 1 });
  await stage.reload();
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByRole('button', { name: 'Grants and robots’ keys…' }).click();
  await expect(held).toHaveText(/^Ada Lovelace may drive: \*, until /);
  await expect(own).toHaveValue(forKey);
});

test('a ticket in a link is taken out of the address, and used only once it was added', async ({ stage }) => {
  const ticket = await ticketFor({ name: 'Wim', role: 'watch' });
  const page = await stage.open({ state: 'not-granted', hash: `#grant=${ticket}` });
  const { read, add, held } = grantsDialog(page);
  await expect(read).toHaveText(/^Wim may watch: \*, until /);
  expect(new URL(page.url()).hash).toBe('');
  await stage.script(admit, { role: 'watch', name: 'Wim', expiresInS: 3600 } as const);
  await stage.run(7000);
  await expect(held).toHaveCount(0);
  expect((await storedKey(page))?.grants).toBe(0);
  expect((await stage.state()).session).toBe('waiting');
  await add.click();
  await expect(held).toHaveText(/^Wim may watch/);
  await stage.run(500);
  expect((await stage.state()).session).toBe('live');
  await expect(page.locator('#holder')).toHaveText('Nobody is driving. Your grant lets you watch');
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
  await stage.resize(1280, 720);
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
  const anna = { number: 1, name: 'Anna', role: 'supervise', drives: false, you: true } as const;
  await stage.tell({ type: 'operators', operators: [anna] });
  await stage.run(300);
  await expect(page.locator('#people')).toContainText('Only you are here');
});

test('a driver whose session a supervisor has ended is told by whom, and does not come back by itself', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'driving' });
  await stage.script(({ link }) => link.end('ended-by-supervisor', 'Sue ended the session'));
  await stage.run(20_000);
  expect((await stage.state()).notice).toContain('Sue ended the session');
  expect(await stage.state()).toMatchObject({ session: 'none', sessionsOpened: 1 });
  // Its own choice asks again, and the robot refuses its grant.
  await stage.script(({ robot, link }) => {
    robot.onRequest = () => link.end('not-granted', 'this grant was revoked');
  });
  await page.getByRole('button', { name: /Robot on a stage/ }).click();
  await stage.run(300);
  await expect(page.getByRole('alertdialog')).toContainText('The robot does not admit you');
  await expect(page.getByRole('alertdialog')).toContainText('this grant was revoked');
  expect(await stage.state()).toMatchObject({ session: 'waiting', sessionsOpened: 1 });
});
