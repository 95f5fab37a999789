/** What is near the robot is shown all around it and named in metres, also where the camera does not see it. */
import { EmulatedLink } from '@farpoint/local-stack';
import { Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { screenSizes } from '../src/screens.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

/** A low box, which the only camera sees from afar only. Its nearest side is 0.75 m before base_link at the start. */
const BOX = { ahead: 0.9, height: 0.09 };
const BOX_SIDE_M = BOX.ahead - 0.15;
const FOOTPRINT_M = 0.25;
const robot = {
  ...lightRobot,
  args: [
    ...[...lightRobot.args, '--sim-size', '160', '--sim-floor', 'unseen'],
    ...['--sim-things', `${BOX.ahead},0,${BOX.height}`],
  ],
};

/** Drives the robot so far that the box is about 0.3 m before it. */
async function approach(operator: OperatorPage): Promise<number> {
  const start = await operator.body();
  await expect
    .poll(
      async () => {
        await operator.page.evaluate(() => window.farpoint.drive({ forward: 0.25, left: 0 }, 120));
        return (await operator.body()).x - start.x;
      },
      { message: 'metres driven', intervals: [50] },
    )
    .toBeGreaterThan(0.14);
  await operator.expectStanding();
  return BOX_SIDE_M - FOOTPRINT_M - ((await operator.body()).x - start.x);
}

const near = async (operator: OperatorPage) => (await operator.state()).near;

/** Waits until the box is named ahead, as far as it is. */
async function expectNamed(operator: OperatorPage, trueM: number): Promise<void> {
  await expect
    .poll(
      async () => {
        const ahead = (await near(operator)).hits.find(({ direction }) => direction === 'ahead');
        return ahead?.kind === 'thing' ? Math.abs(ahead.metres - trueM) : Number.NaN;
      },
      { message: 'error of the distance that is named, m' },
    )
    .toBeLessThan(0.1);
}

test('a thing 0.3 m before the robot is seen from its eye and from above, and named in metres', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id, canvas: 'full' });
  await operator.expectPoints(300);
  // Before anybody drives.
  await expectNamed(operator, BOX_SIDE_M - FOOTPRINT_M);
  const trueM = await approach(operator);
  expect(trueM).toBeGreaterThan(0.1);
  expect(trueM).toBeLessThan(0.4);
  await expectNamed(operator, trueM);
  await expect(page.locator('#near-line')).toHaveText(/^0\.[1-4] m ahead$/);
  // Behind it, no sensor sees.
  await expect(page.locator('#near-more')).toContainText('behind');
  const { ring } = await near(operator);
  expect(ring?.bars).toBeGreaterThan(0);
  expect(ring?.hatched).toBeGreaterThan(20);
  await expect(page.locator('#speed')).toHaveText(/^0\.00 m\/s, at most \d\.\d\d/);

  // From the robot's eye, the middle of the lower edge is red where only black was.
  const redAt = async (x: number, y: number) => {
    const [r, g, b] = await page.evaluate(([x, y]) => window.farpoint.pixel(x, y), [x, y] as const);
    return r - Math.max(g, b);
  };
  await expect.poll(() => redAt(0.5, 0.97), { message: 'red before the robot' }).toBeGreaterThan(30);
  await operator.screenshots(page, testInfo, 'eye');
  await page.keyboard.press('v');
  await operator.screenshot(testInfo, 'third-person');
  await page.keyboard.press('v');
  await page.keyboard.press('t');
  await page.locator('#stage').hover({ position: { x: 400, y: 300 } });
  await page.mouse.wheel(0, -1400);
  // As far from the middle as the thing is said to be from base_link, where the screen's edge is 1.48 m from it. The bar is
  // 8 cm wide, and how far the thing is may change by a cell meanwhile.
  const reddest = async () => {
    const told = (await near(operator)).hits.find(({ direction }) => direction === 'ahead')?.metres ?? 0;
    const reds: number[] = [];
    for (const within of [-0.03, 0, 0.03, 0.06, 0.09]) {
      const ahead = (FOOTPRINT_M + told + within) / (6 * Math.exp(-1.4));
      reds.push(await redAt(0.5, 0.5 - ahead / 2));
    }
    return Math.max(...reds);
  };
  await expect.poll(reddest, { message: 'red before the robot' }).toBeGreaterThan(60);
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await operator.expectFrames(3);
    await operator.screenshot(testInfo, `above-${size.width}`);
  }
});

test('the edge of the view is red where the robot is held, and no longer when it backs out', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  const edge = page.locator('#blocked-edge');
  await expect(edge).toBeHidden();
  await operator.holdForward();
  await expect
    .poll(
      async () => {
        await operator.gripAnew();
        return (await near(operator)).blocked;
      },
      { message: 'where the edge is red', intervals: [100] },
    )
    .toBeCloseTo(0, 1);
  await expect(edge).toBeVisible();
  await expect(page.locator('#speed')).toContainText('held: something is in the way');
  // Whoever looks to the left has it at the right.
  await page.mouse.move(480, 200);
  await page.mouse.down();
  await page.mouse.move(780, 200, { steps: 5 });
  await page.mouse.up();
  await expect
    .poll(
      async () => {
        await operator.gripAnew();
        return (await near(operator)).blocked ?? 0;
      },
      { message: 'where the edge is red', intervals: [100] },
    )
    .toBeLessThan(-0.2);
  await operator.screenshot(testInfo, 'held-looking-left');
  await page.locator('#stage').dblclick({ position: { x: 480, y: 200 } });
  await operator.screenshots(page, testInfo, 'held');
  await operator.release();
  await expect(edge).toBeHidden();
});

test('what is old is shown as old, and then no longer', async ({ page, startStack }, testInfo) => {
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, { args: ['--rate-mbps', '20', '--rtt-ms', '30'] });
  try {
    const { id } = robot;
    await stack.startRobot({ ...robot, args: [...robot.args, '--signaling', link.signalingUrl] });
    const operator = await OperatorPage.open(page, stack, { robot: id });
    await operator.expectPoints(300);
    const line = page.locator('#near-line');
    await expect(line).toHaveText(/^\d\.\d m/);
    link.tell({ type: 'blackhole', direction: 'both', active: true });
    await expect(line).toHaveText(/^\d s old: /);
    expect((await near(operator)).ring?.stale).toBe(true);
    await operator.screenshot(testInfo, 'stale');
    await expect(line).toHaveText('No near-field data');
    expect((await near(operator)).ring).toBe(null);
    await operator.screenshot(testInfo, 'gone');
    link.tell({ type: 'blackhole', direction: 'both', active: false });
    await expect(line).toHaveText(/^\d\.\d m/);
  } finally {
    await link.stop();
  }
});

test('a robot that does not look has no near field, and says so', async ({ page, startStack }) => {
  const stack = await startStack({
    robots: [{ ...robot, args: [...robot.args, '--obstacle-guard', 'off'] }],
  });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  await expect(page.locator('#near-line')).toHaveText('No near-field data');
  expect((await near(operator)).ring).toBe(null);
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('the ring is around the robot, its words are on the wrist, and the edge of the view is red', async ({
    page,
    startStack,
  }, testInfo) => {
    const stack = await startStack({ robots: [robot] });
    const headset = await Headset.wear(page);
    const operator = await OperatorPage.open(page, stack, { robot: robot.id });
    await operator.expectPoints(300);
    await page.getByRole('button', { name: /VR/ }).click();
    await operator.expectState('vr', true);
    await headset.place('left', [-0.05, 1.55, -0.35]);
    const wrist = async () =>
      (await page.evaluate(() => window.farpoint.wrist() ?? [])).map(({ text }) => text);
    await expect.poll(async () => (await wrist()).some((text) => /^\d\.\d m ahead$/.test(text))).toBe(true);
    expect((await wrist()).some((text) => text.startsWith('0.00 m/s, at most'))).toBe(true);
    await operator.expectFrames(5);
    await operator.screenshot(testInfo, 'wrist');
    await headset.place('left', [-0.4, 1, -0.2]);
    await operator.hold(headset.grip('right'));
    await headset.thumbstick('right', 0, -1);
    await expect
      .poll(
        async () => {
          await operator.gripAnew();
          return (await near(operator)).blocked;
        },
        { message: 'where the edge is red', intervals: [100] },
      )
      .toBeCloseTo(0, 1);
    await expect(page.locator('#blocked-edge')).toBeHidden();
    await operator.screenshot(testInfo, 'held');
    await headset.thumbstick('right', 0, 0);
    await operator.release();
  });
});

test('the frusta of the robot’s sensors are drawn when asked for', async ({ page, startStack }, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  await page.keyboard.press('v');
  await page.locator('#colours-open').click();
  const frusta = page.locator('#frusta');
  await expect(frusta).toHaveText('Not drawn');
  await frusta.click();
  await expect(frusta).toHaveText('Drawn');
  await operator.expectFrames(5);
  await operator.screenshot(testInfo, 'frusta');
});
