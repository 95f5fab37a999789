/** What is near the robot is shown all around it and named in metres, and no longer when it is old. */
import { NEAR_SECTORS, type NearSector, nearFieldText } from '@farpoint/protocol';
import { headsetViewport } from '../src/headset.ts';
import { enterVr, wristOf } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import { changedShare } from '../src/stage/pictures.ts';
import type { Rgb, Stage } from '../src/stage/stage.ts';

/** From base_link to the front edge of the scripted robot, metres. */
const FRONT_M = 0.3;
const NOTHING: NearSector = { hit: null, unseen: null };

/** A thing ahead, and floor behind that nobody sees. @param metres from the footprint's edge */
function surroundings(metres: number): string {
  return nearFieldText(
    Array.from({ length: NEAR_SECTORS }, (_, i): NearSector => {
      const off = Math.min(i, NEAR_SECTORS - i);
      if (off <= 4) return { hit: { kind: 'thing', metres }, unseen: null };
      if (off >= 30) return { hit: null, unseen: { fromM: 0, toM: 2 } };
      return NOTHING;
    }),
  );
}

/** The robot says this ten times a second. */
async function goOnTelling(stage: Stage, sectors: string): Promise<void> {
  await stage.script((stage, sectors) => {
    setInterval(() => stage.tell({ type: 'nearField', timeMs: stage.robot.nowMs, sectors }), 100);
  }, sectors);
  await stage.run(400);
}

const near = async (stage: Stage) => (await stage.state()).near;
const redness = ([r, g, b]: Rgb) => r - Math.max(g, b);

test('a thing 0.3 m before the robot is named in metres, and is red where it is, seen from above', async ({
  stage,
}) => {
  const page = await stage.open();
  await expect(page.locator('#near-line')).toHaveText('No near-field data');
  expect((await near(stage)).ring).toBe(null);
  await goOnTelling(stage, surroundings(0.3));
  await expect(page.locator('#near-line')).toHaveText('0.3 m ahead');
  await expect(page.locator('#near-more')).toContainText('unseen: behind');
  const { ring, hits } = await near(stage);
  expect(hits).toEqual([{ direction: 'ahead', kind: 'thing', metres: expect.closeTo(0.3, 2) }]);
  expect(ring?.bars).toBe(9);
  expect(ring?.hatched).toBeGreaterThan(10);
  await expect(page.locator('#speed')).toHaveText('0.00 m/s, at most 0.50');

  await page.keyboard.press('t');
  await page.mouse.move(160, 90);
  await page.mouse.wheel(0, -1400);
  await stage.frames(20);
  const { reachM } = (await stage.state()).scene;
  const redAt = async (ahead: number) => {
    const y = 0.5 - ahead / reachM / 2;
    const around = await stage.pixels({ x: 0.49, y: y - 0.02, width: 0.02, height: 0.04 });
    return Math.max(...around.map(redness));
  };
  // The bar is 8 cm wide.
  expect(await redAt(FRONT_M + 0.3 + 0.04)).toBeGreaterThan(60);
  expect(await redAt(FRONT_M + 0.15)).toBeLessThan(20);
  expect(await redAt(-(FRONT_M + 0.34))).toBeLessThan(20);
});

test('the frusta of the robot’s sensors are drawn when asked for', async ({ stage }) => {
  const page = await stage.open();
  await page.keyboard.press('v');
  await stage.script((stage) => stage.stream(null));
  await stage.frames(10);
  await page.locator('#colours-open').click();
  const frusta = page.locator('#frusta');
  await expect(frusta).toHaveText('Not drawn');
  const without = await stage.pixels();
  expect(changedShare(without, await stage.pixels())).toBe(0);
  await frusta.click();
  await stage.run(100);
  await expect(frusta).toHaveText('Drawn');
  expect(changedShare(without, await stage.pixels())).toBeGreaterThan(0.002);
  await frusta.click();
  await stage.run(100);
  expect(changedShare(without, await stage.pixels())).toBe(0);
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('its words are on the wrist, the ring is drawn, and the edge of the view is the headset’s own', async ({
    stage,
  }) => {
    const headset = await enterVr(stage);
    await headset.place('left', [-0.05, 1.55, -0.35]);
    // Whoever cannot tell has no line there.
    await stage.script(({ robot }) => {
      robot.telemetry = { motion: { factor: 1, reasons: [], mostLinear: 0.5, obstacleGuard: 'on' } };
    });
    await goOnTelling(stage, surroundings(0.3));
    const lines = (await wristOf(stage)).map(({ text }) => text);
    expect(lines).toContain('0.3 m ahead');
    expect(lines).toContain('0.00 m/s, at most 0.50');
    expect((await near(stage)).ring?.bars).toBe(9);
    await headset.place('left', [-0.4, 1, -0.2]);
    await headset.button('right', 'squeeze', 1);
    await headset.thumbstick('right', 0, -1);
    await stage.script(({ robot }) => {
      const motion = { factor: 0, reasons: ['obstacle' as const], mostLinear: 0.5 };
      robot.telemetry = { drive: 'blocked', motion };
    });
    await stage.run(400);
    expect((await near(stage)).blocked).toBeCloseTo(0, 1);
    await expect(stage.page.locator('#blocked-edge')).toBeHidden();
  });
});
