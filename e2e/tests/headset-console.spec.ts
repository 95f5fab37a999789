/** The console in the headset: labels, notices before the eyes, the menu. */
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { HeadsetReader } from '../src/headset-reader.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, LONG, lightRobot, test, twoRobots } from '../src/stack-test.ts';

declare global {
  interface Window {
    /** How often the right controller was told to vibrate. */
    pulses: number;
  }
}

test.use({ viewport: headsetViewport });

const robots = twoRobots.map((robot) => ({ ...robot, args: [...lightRobot.args] }));

for (const driveHand of ['right', 'left'] as const) {
  test(
    `in the headset, ${driveHand}-handed: who never saw it finds drive, stop, release, another robot and the way out from the labels`,
    { tag: driveHand === 'right' ? [] : LONG },
    async ({ page, startStack }, testInfo) => {
      const stack = await startStack({ robots });
      const headset = await Headset.wear(page);
      await headset.settings({ driveHand });
      const operator = await OperatorPage.open(page, stack, { robot: 'sim-1' });
      await operator.expectPoints(300);
      await enterVr(page, operator);
      // Where one looks: labels are there as long as one does.
      await headset.place('left', [-0.1, 1.52, -0.45]);
      await headset.place('right', [0.1, 1.52, -0.45]);
      await headset.frames(20);
      const reader = new HeadsetReader(page, headset);

      const drive = await reader.find(/^Squeeze: drive/);
      expect(drive).toMatchObject({ hand: driveHand, button: 'squeeze' });
      await operator.look(testInfo, 'labels');
      const steer = await reader.find(/steer/);
      const start = await operator.body();
      await operator.hold(headset.grip(drive.hand));
      await headset.thumbstick(steer.hand, 0, -1);
      await operator.expectMovedFrom(start, 0.1);
      await reader.find(/^Let go: the robot stops/, () => operator.gripAnew());
      await operator.look(testInfo, 'labels-driving');
      await operator.release();
      await headset.thumbstick(steer.hand, 0, 0);
      await operator.expectStanding();

      await reader.press(/: STOP$/);
      await operator.expectState('estop', true);
      const release = await reader.find(/Hold 1 s: release STOP/);
      expect(await reader.notice()).toMatch(/^STOP is on .*hold a trigger for one second/);
      await headset.frames(10);
      await operator.look(testInfo, 'labels-stopped');
      await headset.button(release.hand, release.button, 1);
      await operator.expectState('estop', false);
      await headset.button(release.hand, release.button, 0);

      await reader.press(/: menu$/);
      expect(await reader.menu()).toContain('Change robot…');
      await operator.look(testInfo, 'menu');
      await reader.chooseByStick(/^Change robot/);
      await operator.look(testInfo, 'menu-robots');
      await reader.chooseByStick(/^Simulated robot 2/);
      await operator.expectState('robotId', 'sim-2');
      expect(await reader.menu()).toBeNull();
      await operator.expectPoints(300);

      await reader.press(/: menu$/);
      await reader.chooseByStick(/^Leave VR/);
      await operator.expectState('vr', false);
    },
  );
}

test('in the headset the menu lets go of the drive, and its triggers release nothing; STOP stops as ever', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
  await operator.expectPoints(300);
  await enterVr(page, operator);
  const reader = new HeadsetReader(page, headset);
  // Aside: its ray must not be at the menu.
  await headset.place('right', [0.8, 1, -0.3]);
  await headset.place('left', [-0.8, 1, -0.3]);
  const start = await operator.body();
  await operator.hold(headset.grip('right'));
  await headset.thumbstick('right', 0, -1);
  await operator.expectMovedFrom(start, 0.1);

  // The hand holds on, with the stick forward: the robot stops, and the stick moves nothing.
  await headset.press('right', 'a-button');
  await operator.expectState('driving', false);
  await operator.expectStanding();
  const marked = async () => (await reader.console()).menu?.marked;
  expect(await marked()).toBe(1);
  await headset.press('right', 'a-button');
  expect(await reader.menu()).toBeNull();
  await headset.frames(10);
  expect((await operator.state()).driving).toBe(false);
  await operator.release();
  await headset.thumbstick('right', 0, 0);
  await operator.expectState('holder', 'you');

  // By ray: hand the drive back.
  await headset.press('right', 'a-button');
  await reader.chooseByRay('right', /^Hand back/);
  await operator.expectState('holder', 'nobody');
  expect(await reader.menu()).toBeNull();
  await headset.press('right', 'a-button');
  await reader.chooseByRay('left', /^Readings.*all/);
  expect(await reader.menu()).toContain('Readings on the wrist: few');
  await operator.look(testInfo, 'menu-by-ray');

  // STOP by its button, with the menu open; then a trigger pulled at the menu releases nothing.
  await headset.press('right', 'b-button');
  await operator.expectState('estop', true);
  expect(await reader.menu()).not.toBeNull();
  await headset.place('right', await reader.before(/^View/));
  await headset.button('right', 'trigger', 1);
  await operator.expectFrames(25);
  expect((await operator.state()).estop).toBe(true);
  // Nor when the menu has been closed with the trigger held.
  await headset.press('left', 'x-button');
  expect(await reader.menu()).toBeNull();
  await operator.expectFrames(25);
  expect((await operator.state()).estop).toBe(true);
  await headset.button('right', 'trigger', 0);
  await headset.frames(3);
  await headset.button('right', 'trigger', 1);
  await operator.expectState('estop', false);
  await headset.button('right', 'trigger', 0);
});

test('in the headset notices are before the eyes, below the way ahead; a lost link is felt, and stays there', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
  await operator.expectPoints(300);
  await enterVr(page, operator);
  const reader = new HeadsetReader(page, headset);
  await page.evaluate(() => {
    const actuator = window.emulatedHeadset.controllers.right?.inputSource.gamepad?.hapticActuators[0];
    if (actuator === undefined) throw new Error('no actuator');
    actuator.pulse = async () => {
      window.pulses += 1;
      return true;
    };
    window.pulses = 0;
  });
  const pulses = () => page.evaluate(() => window.pulses);

  await headset.press('left', 'x-button');
  await expect.poll(() => reader.notice()).toBe('View in the headset: over the shoulder');
  expect(await pulses()).toBe(0);
  const { notice } = await reader.console();
  expect(notice?.letterDegrees).toBeGreaterThanOrEqual(1);
  expect(notice?.topDegrees).toBeLessThanOrEqual(-20);
  expect(notice?.widthDegrees).toBeLessThan(40);
  await headset.frames(20);
  await operator.look(testInfo, 'notice');

  await headset.thumbstick('right', 0, -1);
  await expect.poll(() => reader.notice()).toBe('Squeeze the grip, too: the robot moves only while you do.');
  await headset.thumbstick('right', 0, 0);

  const before = await pulses();
  await stack.robot(lightRobot.id).kill();
  await expect
    .poll(() => reader.notice(), { timeout: 20_000 })
    .toMatch(/^(Connection lost|The robot is offline|Not connected)/);
  expect(await pulses()).toBeGreaterThan(before);
  await headset.frames(20);
  await operator.look(testInfo, 'lost');
});

test('in the headset without a robot, or disconnected inside: robots are chosen there, also by bare hands', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [] });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack);
  await enterVr(page, operator);
  const reader = new HeadsetReader(page, headset);
  await expect.poll(() => reader.menu()).toContain('No robot is here yet. It appears as soon as it is.');
  await headset.frames(5);
  await operator.look(testInfo, 'no-robot');
  for (const robot of robots) await stack.startRobot(robot);
  await headset.bareHands(true);
  const pinch = async (at: [number, number, number]) => {
    await headset.bareHand('right', at, 0);
    await headset.bareHand('right', at, 1);
    await headset.bareHand('right', at, 0);
  };
  await pinch(await reader.before(/^Simulated robot 1/));
  await operator.expectState('robotId', 'sim-1');
  await operator.expectPoints(300);

  // A bare hand has no buttons: STOP and the menu are on the other one's wrist.
  await headset.bareHand('left', [-0.2, 1.5, -0.6], 0);
  await headset.frames(10);
  await operator.look(testInfo, 'bare-hands');
  await pinch(await reader.beforeTab('stop'));
  await operator.expectState('estop', true);
  await pinch(await reader.beforeTab('menu'));
  await pinch(await reader.before(/^Change robot/));
  await pinch(await reader.before(/^Disconnect/));
  await operator.expectState('session', 'none');
  expect(await reader.menu()).toContain('Simulated robot 2');
  await pinch(await reader.before(/^Simulated robot 2/));
  await operator.expectState('robotId', 'sim-2');
  await operator.expectPoints(300);
  expect((await operator.state()).vr).toBe(true);
});
