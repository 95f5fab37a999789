/** Keys, rows and words for sideways exist only with a robot whose base can. */
import type { Page } from '@playwright/test';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

/** @param maxLateral how fast the robot goes sideways, m/s; undefined: it cannot */
async function connect(stage: Stage, maxLateral: number | undefined): Promise<Page> {
  const page = await stage.open({ state: 'blank' });
  await stage.script((stage, maxLateral) => {
    const { robot } = stage;
    if (maxLateral !== undefined) robot.limits = { ...robot.limits, maxLateral };
    robot.appear(stage.link);
    stage.app.choose(robot.id);
  }, maxLateral);
  await stage.run(500);
  return page;
}

/** What was commanded last while a grip was held. */
async function driven(stage: Stage) {
  const { deadMan, twist } = (await stage.sent('command')).at(-1) ?? {};
  return deadMan === true && twist !== undefined
    ? { x: twist.linear.x, y: twist.linear.y, z: twist.angular.z }
    : null;
}

test('with a robot that goes sideways, its keys do that while the grip is held, and the page says so', async ({
  stage,
}) => {
  const page = await connect(stage, 0.4);
  const { keyboard } = page;
  await keyboard.down('Comma');
  await stage.run(500);
  expect(await driven(stage)).toBe(null);
  await keyboard.down('Space');
  await stage.run(500);
  expect(await driven(stage)).toEqual({ x: 0, y: 0.4, z: 0 });
  await expect(page.locator('#facts')).toContainText('0.40 m/s to the left');
  await keyboard.up('Comma');
  await keyboard.down('Period');
  await keyboard.down('KeyW');
  await stage.run(500);
  const { x = 0, y = 0 } = (await driven(stage)) ?? {};
  expect([Math.hypot(x, y), y / x]).toEqual([expect.closeTo(0.5), expect.closeTo(-0.8)]);
  await stage.forget();
  await keyboard.up('Space');
  await stage.run(300);
  expect((await stage.sent('command'))[0]).toMatchObject({
    deadMan: false,
    twist: { linear: { x: 0, y: 0 } },
  });
  await keyboard.up('Period');
  await keyboard.up('KeyW');

  await keyboard.press('Slash');
  const help = page.getByRole('dialog', { name: 'Help' });
  const row = help.locator('dl > div', { has: page.getByText('Sideways to the left', { exact: true }) });
  await expect(row).toContainText(',');
  await help.getByRole('button', { name: 'Inputs…' }).click();
  await expect(page.locator('#inputs-keys')).toContainText('Sideways to the right');
});

test('with a robot that cannot, they do nothing, and nothing speaks of it', async ({ stage }) => {
  const page = await connect(stage, undefined);
  const { keyboard } = page;
  await keyboard.down('Space');
  await keyboard.down('Comma');
  await stage.run(500);
  expect(await driven(stage)).toEqual({ x: 0, y: 0, z: 0 });
  await keyboard.down('KeyW');
  await stage.run(300);
  expect(await driven(stage)).toEqual({ x: 0.5, y: 0, z: 0 });
  for (const key of ['KeyW', 'Comma', 'Space']) await keyboard.up(key);
  await stage.run(200);
  await keyboard.press('Slash');
  const help = page.getByRole('dialog', { name: 'Help' });
  await expect(help).toContainText('Turn left');
  await expect(help).not.toContainText('Sideways');
  await help.getByRole('button', { name: 'Inputs…' }).click();
  const keys = page.locator('#inputs-keys');
  await expect(keys).toContainText('Turn left');
  await expect(keys).not.toContainText('Sideways');
});
