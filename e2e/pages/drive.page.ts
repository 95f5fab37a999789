/** Hands that drive: the dead man's key, and the next robot from within the headset. */
import { headsetViewport } from '../src/headset.ts';
import { enterVr } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';

test('W drives only while Space is held, and the robot is told to stand as soon as Space is let go', async ({
  stage,
}) => {
  const page = await stage.open();
  await page.keyboard.down('KeyW');
  await stage.run(500);
  const moving = (await stage.sent('command')).filter(
    ({ deadMan, twist }) => deadMan || twist.linear.x !== 0,
  );
  expect(moving).toEqual([]);
  expect(await stage.sent('leaseRequest')).toEqual([]);
  await page.keyboard.up('KeyW');

  await page.keyboard.down('Space');
  await stage.run(300);
  expect((await stage.sent('command')).at(-1)).toMatchObject({ deadMan: true, twist: { linear: { x: 0 } } });
  await page.keyboard.down('KeyW');
  await stage.run(300);
  expect((await stage.sent('command')).at(-1)).toMatchObject({
    deadMan: true,
    twist: { linear: { x: 0.5 } },
  });

  await stage.forget();
  await page.keyboard.up('Space');
  await stage.run(300);
  const after = await stage.sent('command');
  expect(after[0]).toMatchObject({ deadMan: false, twist: { linear: { x: 0 } } });
  expect(after.filter(({ deadMan }) => deadMan)).toEqual([]);
  expect((await stage.state()).velocity?.linear).toBe(0);
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('pressing the stick goes to the next robot, without leaving VR', async ({ stage }) => {
    const headset = await enterVr(stage);
    await stage.script(({ link, robot }) =>
      link.list([
        { id: robot.id, name: robot.name },
        { id: 'stage-2', name: 'Another robot' },
      ]),
    );
    await stage.run(100);
    await headset.press('right', 'thumbstick');
    await stage.run(1000);
    expect(await stage.state()).toMatchObject({ vr: true, robotId: 'stage-2', session: 'live' });
  });
});
