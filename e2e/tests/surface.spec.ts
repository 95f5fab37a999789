import { EmulatedLink } from '@farpoint/local-stack';
import type { Page, TestInfo } from '@playwright/test';
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { leftEye, type Part, readPicture, rightEye, sharesNear } from '../src/picture.ts';
import { expect, LONG, test } from '../src/stack-test.ts';

const CANVAS = '320x240';
const BACKGROUND = [11, 15, 20] as const;
/** Of the page, where no panel lies. */
const MIDDLE = { left: 0.35, top: 0.25, width: 0.3, height: 0.5 };

/** Of the page: a pillar and the floor before it, as the robot's eye sees them; and the floor ahead from above. */
const PILLAR = { left: 0.52, top: 0.25, width: 0.045, height: 0.35 };
const FLOOR = { left: 0.4, top: 0.66, width: 0.2, height: 0.06 };
const AHEAD = { left: 0.45, top: 0.25, width: 0.1, height: 0.12 };

const LOOKS = 5;

/** The whole of a camera's view that a software renderer can follow. */
const robot = {
  id: 'surface',
  name: 'Surface',
  args: [
    ...['--source', 'sim', '--sim-seed', '1', '--sim-size', '192', '--fps', '5'],
    ...['--start-mbps', '20', '--bitrate-mbps', '30'],
  ],
};
/** Most of its points. */
const MOST = 20_000;

/** Share of the picture's middle where nothing is drawn. */
async function holes(page: Page, operator: OperatorPage, testInfo: TestInfo, name: string): Promise<number> {
  const picture = await operator.screenshot(testInfo, name);
  const [share] = await sharesNear(page, picture, MIDDLE, [BACKGROUND], 3);
  return share as number;
}

test('a depth camera’s cloud is drawn as a surface, and a button changes to points', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, {
    ...{ robot: robot.id, canvas: CANVAS, surface: '1', every: '1' },
  });
  await operator.expectPoints(MOST);
  expect(await operator.probe()).toMatchObject({ surface: true });
  await operator.expectFrames(5);
  await expect
    .poll(() => holes(page, operator, testInfo, 'surface'), { message: 'holes in the surface' })
    .toBeLessThan(0.05);
  await page.getByRole('button', { name: 'Colours', exact: true }).click();
  const button = page.getByRole('button', { name: 'Surfaces', exact: true });
  await expect(button).toHaveAttribute('aria-pressed', 'true');
  await button.click();
  await expect(button).toHaveAttribute('aria-pressed', 'false');
  await expect.poll(async () => (await operator.probe()).surface, { message: 'surface' }).toBe(false);
  await operator.expectPoints(MOST);
  // A busy machine draws some frames before all of their points have come.
  await expect
    .poll(() => holes(page, operator, testInfo, 'points'), { message: 'holes between points' })
    .toBeLessThan(0.05);
  await button.click();
  await expect.poll(async () => (await operator.probe()).surface, { message: 'surface' }).toBe(true);
});

test(
  'lit colours: the floor, seen at a slant, is darker than what faces the eye',
  { tag: LONG },
  async ({ page, startStack }, testInfo) => {
    const stack = await startStack({ robots: [robot] });
    const operator = await OperatorPage.open(page, stack, {
      ...{ robot: robot.id, canvas: CANVAS, surface: '1', every: '1', memory: '0' },
    });
    await operator.expectPoints(MOST);
    await page.getByRole('button', { name: 'Colours', exact: true }).click();
    const mode = page.getByLabel('Colours of Cloud');
    /** How much of the lightness of parts of the page is left when they are lit. People may walk through them. */
    const leftOf = async (name: string, parts: Part[]): Promise<number[]> => {
      const taken: number[][] = [];
      for (const chosen of ['captured', 'lit']) {
        await mode.selectOption(chosen);
        await operator.expectFrames(2);
        await expect(page.locator('#link')).toHaveText('Live');
        const facts = await readPicture(
          page,
          await operator.screenshot(testInfo, `${name}-${chosen}`),
          parts,
        );
        taken.push(facts.map(({ lightness }) => lightness));
      }
      const [captured, lit] = taken as [number[], number[]];
      return parts.map((_, i) => (lit[i] as number) / (captured[i] as number));
    };
    const differs = async () => {
      const [pillar, floor] = (await leftOf('eye', [PILLAR, FLOOR])) as [number, number];
      return pillar > 0.7 && pillar < 1.05 && floor < pillar - 0.15;
    };
    await expect
      .poll(differs, { message: 'the floor is darker than the pillar', timeout: 60_000 })
      .toBe(true);
    await expect(page.locator('.legend')).toContainText('lit from the eye');
    // A busy machine draws some frames before all of their points have come.
    await expect
      .poll(() => holes(page, operator, testInfo, 'lit-holes'), { message: 'holes in the lit surface' })
      .toBeLessThan(0.05);
    // From above, the floor faces the eye.
    await page.keyboard.press('t');
    const faces = async () => (await leftOf('above', [AHEAD]))[0];
    await expect
      .poll(faces, { message: 'share of the floor’s lightness', timeout: 60_000 })
      .toBeGreaterThan(0.75);
    // Points have no normals, and the legend says so.
    await page.getByRole('button', { name: 'Surfaces', exact: true }).click();
    await expect(page.locator('.legend')).toContainText('points, not lit');
  },
);

test(
  'lost packets leave no holes: what was seen there before stays',
  { tag: LONG },
  async ({ page, startStack }, testInfo) => {
    const stack = await startStack({ robots: [] });
    const link = await EmulatedLink.start(stack, {
      args: ['--rate-mbps', '40', '--rtt-ms', '20'],
      statsFile: testInfo.outputPath('link.jsonl'),
    });
    try {
      await stack.startRobot({ ...robot, args: [...robot.args, '--signaling', link.signalingUrl] });
      const operator = await OperatorPage.open(page, stack, {
        ...{ robot: robot.id, canvas: CANVAS, surface: '1', every: '1' },
      });
      await operator.expectPoints(MOST);
      await operator.expectFrames(5);
      const before = await holes(page, operator, testInfo, 'without-loss');
      link.tell({ type: 'set', direction: 'both', loss: 0.1 });
      await expect.poll(async () => (await operator.stats()).packetsLost).toBeGreaterThan(50);
      // A tenth of each picture would be missing. People who walk by hide as much as their shadow.
      let sum = 0;
      for (let i = 0; i < LOOKS; i++) {
        await operator.expectFrames(0);
        sum += await holes(page, operator, testInfo, `with-loss-${i}`);
      }
      expect(sum / LOOKS).toBeLessThan(before + 0.06);
    } finally {
      await link.stop();
    }
  },
);

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('both eyes see the surface', async ({ page, startStack }, testInfo) => {
    const stack = await startStack({ robots: [robot] });
    await Headset.wear(page);
    const operator = await OperatorPage.open(page, stack, { robot: robot.id, surface: '1' });
    await operator.expectPoints(10_000);
    await enterVr(page, operator);
    await operator.expectFrames(5);
    expect(await operator.probe()).toMatchObject({ surface: true });
    const picture = await operator.screenshot(testInfo, 'surface-both-eyes');
    for (const eye of await readPicture(page, picture, [leftEye, rightEye])) {
      expect(eye.drawnShare).toBeGreaterThan(0.2);
      expect(eye.colours).toBeGreaterThan(15);
    }
  });
});
