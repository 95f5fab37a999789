import { expect, test } from '../src/stage/page-test.ts';

const NOT_YET = 'STOP not yet confirmed';

test('STOP that is pressed while the network is away arrives at its return, and the page says both', async ({
  stage,
}) => {
  const page = await stage.open();
  const state = page.locator('#stop-state');
  await expect(state).toBeHidden();
  await stage.script((stage) => stage.cut());
  await stage.run(2000);
  await expect(page.locator('#link')).toHaveText(/Connection lost for \d+ s/);
  await page.locator('#estop').click();
  await stage.run(300);
  await expect(state).toHaveText(NOT_YET);
  await stage.run(20_000);
  await expect(state).toHaveText(NOT_YET);
  expect(await stage.script(({ robot }) => robot.estop.latched)).toBe(false);

  await stage.script((stage) => stage.restore());
  await stage.run(600);
  expect(await stage.script(({ robot }) => robot.estop)).toMatchObject({ latched: true, latch: 1 });
  await stage.run(300);
  await expect(state).toHaveText('STOP confirmed');
  expect((await stage.state()).estop).toBe(true);

  // What is released is no longer spoken of, and a press on a path that holds is confirmed as well.
  await page.keyboard.down('KeyR');
  await stage.run(1500);
  await page.keyboard.up('KeyR');
  await expect(state).toBeHidden();
  await page.locator('#estop').click();
  await stage.run(300);
  await expect(state).toHaveText('STOP confirmed');
});
