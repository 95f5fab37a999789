/** A headset that hangs with the grip held: nothing reads the hand any more, so it counts as open. */
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

/** Since when what holds now has held, ms since the page loaded; `null` while it does not. */
interface StopTimes {
  letGoMs: number | null;
  toldMs: number | null;
  standsMs: number | null;
}

test.use({ viewport: headsetViewport });

test('in the headset: frames that stop with the grip held stop the robot until the grip is opened', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: 'sim-1' });
  await operator.expectPoints(300);
  await enterVr(page, operator);
  await operator.expectPoints(300);

  const drive = () =>
    expect
      .poll(
        async () => {
          await operator.gripAnew();
          const { driving, velocity } = await operator.state();
          return driving && Math.abs(velocity?.angular ?? 0) > 0.1;
        },
        { message: 'driving', intervals: [100] },
      )
      .toBe(true);
  // It turns on the spot: however often a slow page lets go, nothing comes into its way.
  await headset.thumbstick('right', -1, 0);
  await operator.hold(headset.grip('right'));
  await drive();

  await page.evaluate(() => {
    const stop: StopTimes = { letGoMs: null, toldMs: null, standsMs: null };
    window.stopTimes = stop;
    setInterval(() => {
      const now = performance.now();
      const { driving, drive, velocity } = window.farpoint.state();
      stop.letGoMs = driving ? null : (stop.letGoMs ?? now);
      stop.toldMs = drive === 'driving' ? null : (stop.toldMs ?? now);
      stop.standsMs = velocity?.angular === 0 ? (stop.standsMs ?? now) : null;
    }, 5);
  });
  const frozenMs = await headset.freeze();
  await operator.expectStanding();
  await operator.expectState('gripLost', 'late-reading');
  const { letGoMs, toldMs, standsMs } = await page.evaluate(() => window.stopTimes);
  const after = (ms: number | null) => ((ms ?? Number.NaN) - frozenMs).toFixed(0);
  console.log(
    `after the headset's last frame the hand counts as open in ${after(letGoMs)} ms; the page hears that the robot ` +
      `brakes in ${after(toldMs)} ms, and that it stands in ${after(standsMs)} ms`,
  );
  await operator.look(testInfo, 'frozen');

  // The frames come back, the hand still holds on: the robot keeps standing while they are read.
  const stood = await operator.body();
  await headset.thaw();
  await operator.expectFrames(20);
  const { driving, gripLost } = await operator.state();
  expect({ driving, gripLost }).toEqual({ driving: false, gripLost: 'late-reading' });
  const later = await operator.body();
  expect(Math.abs(later.yaw - stood.yaw)).toBeLessThan(0.01);

  // A fresh grip drives.
  await drive();
  await operator.release();
  await operator.expectStanding();
});

declare global {
  interface Window {
    stopTimes: StopTimes;
  }
}
