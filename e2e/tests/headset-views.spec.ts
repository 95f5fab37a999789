/** Views in the headset: first person, over the shoulder, and the world as a model on a table. */
import type { HeadsetProbe } from '@farpoint/webxr/test-api';
import type { Page } from '@playwright/test';
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

test.use({ viewport: headsetViewport });

const robot = { ...simulatedRobot, args: [...simulatedRobot.args, '--max-points', '6000', '--fps', '15'] };

async function probe(page: Page): Promise<HeadsetProbe> {
  const shown = await page.evaluate(() => window.farpoint.headset());
  if (shown === null) throw new Error('not in VR');
  return shown;
}

/** @returns reads what the page has told since. A busy machine may have something more to say at once. */
async function notices(page: Page): Promise<() => Promise<string[]>> {
  const told = await page.evaluateHandle(() => {
    const texts: string[] = [];
    const notice = document.querySelector('#notice');
    if (notice === null) throw new Error('no notice');
    new MutationObserver(() => texts.push(notice.textContent ?? '')).observe(notice, { childList: true });
    return texts;
  });
  return () => told.jsonValue();
}

test('in the headset, X shows the next view: the robot drives in each, and a change lets go of the grip', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints();
  await enterVr(page, operator);
  await operator.expectFrames(3);
  const drive = async () => {
    const from = await operator.body();
    await operator.hold(headset.grip('right'));
    await headset.thumbstick('right', 0, -1);
    await operator.expectMovedFrom(from, 0.1);
  };
  const stop = async () => {
    await operator.release();
    await headset.thumbstick('right', 0, 0);
    await operator.expectStanding();
  };
  const { camera } = await operator.probe();
  const first = await probe(page);
  expect(first.view).toBe('first-person');
  await drive();

  // The hand holds on, but the robot stops, and waits for a fresh grip.
  const told = await notices(page);
  await headset.press('left', 'x-button');
  expect((await probe(page)).view).toBe('over-shoulder');
  await expect.poll(told).toContain('View in the headset: over the shoulder');
  await operator.expectState('driving', false);
  await operator.expectStanding();
  await operator.look(testInfo, 'over-shoulder-said');
  await stop();
  const behind = await probe(page);
  expect(behind.eyes.z - (camera?.z ?? 0)).toBeCloseTo(0.6, 1);
  await drive();
  await operator.look(testInfo, 'over-shoulder');
  await stop();

  // Pressed on the flat page, V is the same button.
  await page.keyboard.press('KeyV');
  expect((await probe(page)).view).toBe('tabletop');
  await headset.frames(3);
  expect((await probe(page)).eyes.z).toBeGreaterThan(5);
  await drive();
  await stop();
  await headset.place('left', [-0.1, 1.5, -0.4]);
  await expect
    .poll(() =>
      page.evaluate(() =>
        window.farpoint
          .wrist()
          ?.map(({ text }) => text)
          .join('\n'),
      ),
    )
    .toContain('Tabletop 1:20');
  await operator.look(testInfo, 'tabletop');
  await headset.press('left', 'x-button');
  expect((await probe(page)).view).toBe('first-person');
});

test('in the headset, triggers hold the model on the table: no grip drives meanwhile', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints();
  await enterVr(page, operator);
  // In first person, there is nothing to hold.
  const first = await probe(page);
  await headset.place('left', [-0.2, 1.2, -0.4]);
  await headset.button('left', 'trigger', 1);
  await headset.frames(3);
  await headset.place('left', [0.2, 1.2, -0.4]);
  await headset.frames(3);
  await headset.button('left', 'trigger', 0);
  expect((await probe(page)).model).toEqual(first.model);

  await page.keyboard.press('KeyV');
  await page.keyboard.press('KeyV');
  await headset.place('left', [-0.2, 1.2, -0.4]);
  await headset.place('right', [0.2, 1.2, -0.4]);
  await headset.frames(3);
  const before = await probe(page);
  expect(before.view).toBe('tabletop');
  await headset.button('left', 'trigger', 1);
  await headset.frames(3);
  await headset.place('left', [-0.1, 1.3, -0.5]);
  await headset.frames(3);
  const moved = await probe(page);
  expect(moved.model.x - before.model.x).toBeCloseTo(0.1, 6);
  expect(moved.model.y - before.model.y).toBeCloseTo(0.1, 6);
  expect(moved.model.z - before.model.z).toBeCloseTo(-0.1, 6);
  expect(moved.yaw).toBe(before.yaw);

  // A fist that holds the model drives nothing, also when the model is let go.
  const stood = await operator.body();
  await headset.button('right', 'trigger', 1);
  await headset.frames(3);
  await headset.thumbstick('right', 0, -1);
  await headset.button('right', 'squeeze', 1);
  await headset.place('right', [0.3, 1.3, -0.5]);
  await operator.expectFrames(5);
  const scaled = await probe(page);
  expect(scaled.model.scale / moved.model.scale).toBeGreaterThan(1.2);
  await operator.look(testInfo, 'tabletop-held');
  await headset.button('left', 'trigger', 0);
  await headset.button('right', 'trigger', 0);
  await operator.expectFrames(5);
  expect((await operator.state()).driving).toBe(false);
  const still = await operator.body();
  expect(Math.hypot(still.x - stood.x, still.y - stood.y)).toBeLessThan(0.01);

  // Opened and squeezed anew, it drives; while it does, a trigger holds nothing.
  await headset.button('right', 'squeeze', 0);
  await headset.frames(3);
  await operator.hold(headset.grip('right'));
  await operator.expectMovedFrom(still, 0.1);
  await headset.button('left', 'trigger', 1);
  await headset.frames(3);
  const held = await probe(page);
  await headset.place('left', [0.1, 1.3, -0.5]);
  await headset.frames(3);
  expect((await probe(page)).model).toEqual(held.model);
  await operator.release();
  await headset.button('left', 'trigger', 0);
  await operator.expectStanding();

  // Recentring puts the model back, and its robot's heading ahead.
  await headset.press('left', 'thumbstick');
  expect((await probe(page)).model.scale).toBeCloseTo(before.model.scale, 9);
});

test('in the headset, bare hands hold the model by pinching, and drive and release nothing', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints();
  await enterVr(page, operator);
  await page.keyboard.press('KeyV');
  await page.keyboard.press('KeyV');
  const start = await operator.body();
  await operator.hold(headset.grip('right'));
  await headset.thumbstick('right', 0, -1);
  await operator.expectMovedFrom(start, 0.1);

  // Whoever puts the controllers down lets go.
  await headset.bareHands(true);
  await operator.expectState('driving', false);
  await operator.expectStanding();
  await headset.bareHand('left', [-0.2, 1.2, -0.4], 0);
  await headset.bareHand('right', [0.2, 1.2, -0.4], 0);
  const before = await probe(page);
  await headset.bareHand('left', [-0.2, 1.2, -0.4], 1);
  await headset.bareHand('right', [0.2, 1.2, -0.4], 1);
  const both = await probe(page);
  await headset.bareHand('left', [-0.4, 1.2, -0.4], 1);
  const scaled = await probe(page);
  expect(scaled.model.scale / both.model.scale).toBeGreaterThan(1.2);
  expect(before.model.scale).toBeCloseTo(both.model.scale, 3);
  await operator.look(testInfo, 'bare-hands');
  await headset.bareHand('left', [-0.4, 1.2, -0.4], 0);
  await headset.bareHand('right', [0.2, 1.2, -0.4], 0);

  // A pinch of any length releases no emergency stop.
  await page.keyboard.press('KeyX');
  await operator.expectState('estop', true);
  await headset.bareHand('right', [0.2, 1.2, -0.4], 1);
  await operator.expectFrames(25);
  expect((await operator.state()).estop).toBe(true);
  expect((await operator.state()).driving).toBe(false);
});
