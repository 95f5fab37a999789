/** Views in the headset: first person, over the shoulder, the world as a model on a table, and in one's own room. */
import { headsetViewport } from '../src/headset.ts';
import { enterVr, shownIn, wristOf } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';

test.use({ viewport: headsetViewport });

test('X shows the next view: the robot drives in each, and a change lets go of the grip', async ({
  stage,
}) => {
  const headset = await enterVr(stage);
  const { page } = stage;
  const grip = async () => {
    await headset.button('right', 'squeeze', 0);
    await headset.thumbstick('right', 0, -1);
    await stage.frames(5);
    await headset.button('right', 'squeeze', 1);
    await stage.run(300);
    expect((await stage.state()).driving).toBe(true);
  };
  const { camera } = await stage.probe();
  expect((await shownIn(stage)).view).toBe('first-person');
  await grip();
  // The hand holds on, but the robot stops, and waits for a fresh grip.
  await headset.press('left', 'x-button');
  expect((await stage.state()).notice).toBe('View in the headset: over the shoulder');
  await stage.run(400);
  expect((await shownIn(stage)).view).toBe('over-shoulder');
  expect(await stage.state()).toMatchObject({ driving: false, velocity: { linear: 0 } });
  expect((await shownIn(stage)).eyes.z - (camera?.z ?? Number.NaN)).toBeCloseTo(0.6, 1);
  await grip();
  await headset.button('right', 'squeeze', 0);

  // Pressed on the flat page, V is the same button.
  await page.keyboard.press('KeyV');
  await stage.frames(5);
  expect((await shownIn(stage)).view).toBe('tabletop');
  expect((await shownIn(stage)).eyes.z).toBeGreaterThan(5);
  await grip();
  await headset.place('left', [-0.1, 1.5, -0.4]);
  await stage.run(400);
  expect((await wristOf(stage)).map(({ text }) => text).join('\n')).toContain('Tabletop 1:20');
  await headset.press('left', 'x-button');
  expect((await shownIn(stage)).view).toBe('first-person');
});

test('triggers hold the model on the table: no grip drives meanwhile, and recentring puts it back', async ({
  stage,
}) => {
  const headset = await enterVr(stage);
  const { page } = stage;
  // In first person, there is nothing to hold.
  const first = await shownIn(stage);
  await headset.place('left', [-0.2, 1.2, -0.4]);
  await headset.button('left', 'trigger', 1);
  await stage.frames(3);
  await headset.place('left', [0.2, 1.2, -0.4]);
  await stage.frames(3);
  await headset.button('left', 'trigger', 0);
  expect((await shownIn(stage)).model).toEqual(first.model);

  await page.keyboard.press('KeyV');
  await page.keyboard.press('KeyV');
  await headset.place('left', [-0.2, 1.2, -0.4]);
  await headset.place('right', [0.2, 1.2, -0.4]);
  await stage.frames(3);
  const before = await shownIn(stage);
  expect(before.view).toBe('tabletop');
  await headset.button('left', 'trigger', 1);
  await stage.frames(3);
  await headset.place('left', [-0.1, 1.3, -0.5]);
  await stage.frames(3);
  const moved = await shownIn(stage);
  expect(moved.model.x - before.model.x).toBeCloseTo(0.1, 6);
  expect(moved.model.y - before.model.y).toBeCloseTo(0.1, 6);
  expect(moved.model.z - before.model.z).toBeCloseTo(-0.1, 6);
  expect(moved.yaw).toBe(before.yaw);

  // A fist that holds the model drives nothing, also when the model is let go.
  await headset.button('right', 'trigger', 1);
  await stage.frames(3);
  await headset.thumbstick('right', 0, -1);
  await headset.button('right', 'squeeze', 1);
  await headset.place('right', [0.3, 1.3, -0.5]);
  await stage.run(200);
  expect((await shownIn(stage)).model.scale / moved.model.scale).toBeGreaterThan(1.2);
  await headset.button('left', 'trigger', 0);
  await headset.button('right', 'trigger', 0);
  await stage.run(300);
  expect(await stage.state()).toMatchObject({ driving: false, velocity: { linear: 0 } });

  // Opened and squeezed anew, it drives; while it does, a trigger holds nothing.
  await headset.button('right', 'squeeze', 0);
  await stage.frames(3);
  await headset.button('right', 'squeeze', 1);
  await stage.run(300);
  expect((await stage.state()).driving).toBe(true);
  await headset.button('left', 'trigger', 1);
  await stage.frames(3);
  const held = await shownIn(stage);
  await headset.place('left', [0.1, 1.3, -0.5]);
  await stage.frames(3);
  expect((await shownIn(stage)).model).toEqual(held.model);
  await headset.button('right', 'squeeze', 0);
  await headset.button('left', 'trigger', 0);
  await stage.frames(3);
  await headset.press('left', 'thumbstick');
  expect((await shownIn(stage)).model.scale).toBeCloseTo(before.model.scale, 9);
});

test('bare hands hold the model by pinching, and drive and release nothing', async ({ stage }) => {
  const headset = await enterVr(stage);
  const { page } = stage;
  await page.keyboard.press('KeyV');
  await page.keyboard.press('KeyV');
  await stage.frames(5);
  await headset.thumbstick('right', 0, -1);
  await headset.button('right', 'squeeze', 1);
  await stage.run(300);
  expect((await stage.state()).driving).toBe(true);
  // Whoever puts the controllers down lets go.
  await headset.bareHands(true);
  await stage.run(100);
  expect((await stage.state()).driving).toBe(false);
  await headset.bareHand('left', [-0.2, 1.2, -0.4], 0);
  await headset.bareHand('right', [0.2, 1.2, -0.4], 0);
  const before = await shownIn(stage);
  await headset.bareHand('left', [-0.2, 1.2, -0.4], 1);
  await headset.bareHand('right', [0.2, 1.2, -0.4], 1);
  const both = await shownIn(stage);
  await headset.bareHand('left', [-0.4, 1.2, -0.4], 1);
  expect((await shownIn(stage)).model.scale / both.model.scale).toBeGreaterThan(1.2);
  expect(before.model.scale).toBeCloseTo(both.model.scale, 3);
  await headset.bareHand('left', [-0.4, 1.2, -0.4], 0);
  await headset.bareHand('right', [0.2, 1.2, -0.4], 0);

  // A pinch of any length releases no emergency stop.
  await page.keyboard.press('KeyX');
  await stage.run(200);
  await headset.bareHand('right', [0.2, 1.2, -0.4], 1);
  await stage.run(2000);
  expect(await stage.state()).toMatchObject({ estop: true, driving: false });
});

test('in AR the model stands in the operator’s room, or the world around them at true scale', async ({
  stage,
}) => {
  const { page } = stage;
  const headset = await enterVr(stage);
  await page.getByRole('button', { name: 'Leave VR' }).dispatchEvent('click');
  await stage.frames(5);
  await page.getByRole('button', { name: 'Enter AR' }).click();
  await stage.frames(20);
  expect(await shownIn(stage)).toMatchObject({ view: 'tabletop', passthrough: true });
  // Where nothing is drawn, the headset shows the room: the emulated one shows black.
  const corner = { x: 0, y: 0, width: 0.02, height: 0.02 };
  expect(await stage.share([0, 0, 0], corner, 0)).toBe(1);
  expect(await stage.share([0, 0, 0])).toBeLessThan(0.99);
  await headset.thumbstick('right', 0, -1);
  await headset.button('right', 'squeeze', 1);
  await stage.run(300);
  expect((await stage.state()).driving).toBe(true);
  await headset.button('right', 'squeeze', 0);
  await headset.press('left', 'x-button');
  expect(await shownIn(stage)).toMatchObject({ view: 'first-person' });

  // Back in VR, the view is the one from before.
  await page.getByRole('button', { name: 'Leave AR' }).dispatchEvent('click');
  await stage.frames(5);
  await page.getByRole('button', { name: 'Enter VR' }).click();
  await stage.frames(20);
  expect(await shownIn(stage)).toMatchObject({ view: 'first-person', passthrough: false });
  expect(await stage.share([0, 0, 0], corner, 0)).toBe(0);
});
