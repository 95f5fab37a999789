/** The view answers the hand at once, although the robot is 200 ms away, and the page says that this is a prediction. */
import { headsetViewport } from '../src/headset.ts';
import { enterVr, wristOf } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import { FRAME_MS, type Stage } from '../src/stage/stage.ts';

/** From a command to the telemetry that shows what it has done. */
const LOOP_MS = 200;
/** What counts as a motion, metres. */
const MOVED_M = 5e-5;

/** The robot is away by half of the loop in each direction, and gains speed at once. */
async function sendAway(stage: Stage): Promise<void> {
  await stage.script((stage, delayMs) => {
    stage.robot.delayMs = delayMs;
    const { welcome } = stage.link.session;
    if (welcome?.body !== undefined)
      stage.tell({ ...welcome, body: { footprint: welcome.body.footprint, decelerationMps2: 5 } });
  }, LOOP_MS / 2);
  await stage.run(1000);
}

interface Motion {
  /** When the view has moved, and when the telemetry tells that the body has, ms after the key; multiples of a frame. */
  viewMs: number;
  bodyMs: number;
}

/** Pushes forward, with the grip already held, and looks at every display frame. */
async function push(stage: Stage): Promise<Motion> {
  const { page } = stage;
  await page.keyboard.down('Space');
  await stage.run(600);
  await stage.script(
    (_, [frameMs, movedM]) => {
      const motion = { viewMs: Number.NaN, bodyMs: Number.NaN };
      Object.assign(window, { motion });
      const from = window.farpoint.state();
      let ms = 0;
      const timer = setInterval(() => {
        ms += frameMs;
        const { view, body } = window.farpoint.state();
        const hasMoved = Math.hypot(view.x - from.view.x, view.y - from.view.y) > movedM;
        if (Number.isNaN(motion.viewMs) && hasMoved) motion.viewMs = ms;
        if (Number.isNaN(motion.bodyMs) && Math.abs((body?.x ?? 0) - (from.body?.x ?? 0)) > movedM)
          motion.bodyMs = ms;
        if (ms > 600) clearInterval(timer);
      }, frameMs);
    },
    [FRAME_MS, MOVED_M] as const,
  );
  await page.keyboard.down('KeyW');
  await stage.run(3 * LOOP_MS);
  const motion = await page.evaluate(() => (window as unknown as { motion: Motion }).motion);
  await page.keyboard.up('KeyW');
  await page.keyboard.up('Space');
  await stage.run(2000);
  return motion;
}

test('flat: the view moves within three display frames of the key, and with P or ?predict=0 as late as the robot', async ({
  stage,
}) => {
  const page = await stage.open();
  const facts = page.locator('#facts');
  await expect(facts).toContainText('As reported');
  await sendAway(stage);
  // The first grip gets the lease.
  await push(stage);
  const predicted = await push(stage);
  expect(predicted.viewMs).toBeLessThanOrEqual(3 * FRAME_MS);
  expect(predicted.bodyMs).toBeGreaterThanOrEqual(LOOP_MS);
  // View and robot agree again once it stands.
  const [{ view, body }, { camera }] = [await stage.state(), await stage.probe()];
  expect(Math.hypot(view.x - (camera?.x ?? 0), view.y - (camera?.y ?? 0))).toBeLessThan(0.01);
  expect(Math.abs(view.x - (body?.x ?? 0))).toBeLessThan(0.01);

  await page.keyboard.press('p');
  await stage.run(300);
  await expect(facts).toContainText('prediction is off');
  const followed = await push(stage);
  expect(followed.viewMs).toBeGreaterThanOrEqual(LOOP_MS);
  await page.keyboard.press('p');
  await stage.run(300);
  await expect(facts).not.toContainText('prediction is off');
  await stage.open({ query: { predict: '0' } });
  await expect(facts).toContainText('prediction is off');
});

test('the page says how far ahead the view is, and STOP is believed before the robot has confirmed it', async ({
  stage,
}) => {
  const page = await stage.open();
  await sendAway(stage);
  await page.keyboard.down('Space');
  await stage.run(600);
  await page.keyboard.down('KeyW');
  await stage.run(1000);
  const { view } = await stage.state();
  expect(view.state).toBe('predicted');
  expect(view.aheadMs).toBeGreaterThan(LOOP_MS / 2);
  expect(view.aheadMs).toBeLessThan(LOOP_MS * 1.5);
  await expect(page.locator('#facts')).toContainText(/Predicted \d+ ms ahead/);
  await page.keyboard.press('x');
  await stage.run(50);
  expect((await stage.state()).estop).toBe(false);
  expect((await stage.state()).view.state).not.toBe('predicted');
  await stage.run(500);
  await expect(page.locator('#facts')).toContainText('As reported: the robot is held');
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('the rig moves at once, and the wrist says that it is predicted', async ({ stage }) => {
    const headset = await enterVr(stage);
    await sendAway(stage);
    await headset.button('right', 'squeeze', 1);
    await stage.run(600);
    const { view: from } = await stage.state();
    await headset.thumbstick('right', 0, -1);
    await stage.frames(4);
    const { view } = await stage.state();
    expect(Math.hypot(view.x - from.x, view.y - from.y)).toBeGreaterThan(MOVED_M);
    await stage.run(600);
    const lines = (await wristOf(stage)).map(({ text }) => text).join('\n');
    expect(lines).toMatch(/view \+\d+ ms predicted/);
  });
});
