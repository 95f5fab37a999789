/** A hand on the controls that moves nothing is told why, and what to do. */
import { expect, test } from '../src/stage/page-test.ts';

test('a key without the grip: the page says what to hold, once; with the grip there is nothing to say', async ({
  stage,
}) => {
  const page = await stage.open();
  await stage.run(6000);
  const notice = page.locator('#notice');
  await page.keyboard.down('KeyW');
  await stage.run(300);
  await expect(notice).toBeHidden();
  await stage.run(300);
  await expect(notice).toHaveText('Hold Space, too: the robot moves only while you do.');
  expect((await stage.state()).holder).toBe('nobody');
  await stage.run(6000);
  await expect(notice).toBeHidden();
  await page.keyboard.up('KeyW');
  await page.keyboard.down('Space');
  await page.keyboard.down('KeyW');
  await stage.run(1000);
  await expect(notice).toBeHidden();
  expect((await stage.state()).driving).toBe(true);
});

test('who may not drive is told that instead', async ({ stage }) => {
  const page = await stage.open({ state: 'other-drives' });
  await stage.run(6000);
  await page.keyboard.down('KeyW');
  await stage.run(600);
  await expect(page.locator('#notice')).toContainText('choose Take over');
});

test('a takeover is told by name to the one who drove, for as long as the hand holds on', async ({
  stage,
}) => {
  const page = await stage.open();
  await page.keyboard.down('Space');
  await stage.run(300);
  expect((await stage.state()).holder).toBe('you');
  await stage.script(({ robot }) => robot.giveLease('other', 'Bo'));
  await stage.run(300);
  const banner = page.locator('#banner');
  await expect(banner.locator('b')).toHaveText('Taken over');
  await expect(banner).toContainText('Bo has taken over and drives now. You do not. Let go of the grip.');
  // It asks for no haste: the robot is in other hands.
  await expect(banner).toHaveRole('status');
  await stage.run(10_000);
  await expect(banner).toBeVisible();
  await page.keyboard.up('Space');
  await stage.run(300);
  await expect(banner).toBeHidden();

  // Without a hand on the controls it is a notice that goes by itself.
  await stage.script(({ robot }) => robot.giveLease('you'));
  await stage.run(300);
  await stage.script(({ robot }) => robot.giveLease('other', 'Bo'));
  await stage.run(300);
  await expect(page.locator('#notice')).toHaveText('Bo has taken over and drives now. You do not.');
  await expect(banner).toBeHidden();
});

test('a grip that was held while the path was away: the page asks to let go of it', async ({ stage }) => {
  const page = await stage.open();
  await page.keyboard.down('Space');
  await stage.run(300);
  await stage.script((control) => control.cut());
  await stage.run(2000);
  await stage.script((control) => control.restore());
  await stage.run(1000);
  const banner = page.locator('#banner');
  await expect(banner.locator('b')).toHaveText('Let go of the grip');
  await page.keyboard.up('Space');
  await stage.run(300);
  await expect(banner).toBeHidden();
});
