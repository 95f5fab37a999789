/** The depth camera's surface with the colours of its own video. */
import { headsetViewport } from '../src/headset.ts';
import { enterVr } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import { screenPlace } from '../src/stage/places.ts';
import type { Rgb, Stage } from '../src/stage/stage.ts';
import { SURFACES_ALONE } from '../src/stored.ts';

const NAME = 'Depth camera';
const WHITE: Rgb = [255, 255, 255];
const RED: Rgb = [255, 0, 0];
const GREEN: Rgb = [0, 255, 0];
const BLUE: Rgb = [0, 0, 255];
const CANVAS = { width: 160, height: 90 };
const CANVAS_SIZE = `${CANVAS.width}x${CANVAS.height}`;
/** Of the cloud's grid, pixels. */
const SIZE = { width: 240, height: 180 };
/** From the capture of a cloud and its picture until they come, ms. */
const AGE_MS = 40;
/** How much is painted is told as a mean over less, ms. */
const MEAN_MS = 600;
/** Of the page, where only the wall is: where depths jump, a surface has an end. */
const WALL = { x: 0.35, y: 0.25, width: 0.3, height: 0.25 };

/** Until what is drawn has changed its colours, ms. */
const BLENDED_MS = 170;

type Picture = NonNullable<Parameters<Stage['video']>[1]>;

async function offer(stage: Stage): Promise<void> {
  await stage.load('depth-room');
  await stage.tell({ type: 'videos', videos: [{ name: NAME, mid: 'v0', codec: 'VP8', ofSensor: 0 }] });
  await stage.run(300);
}

/** A cloud comes, after its picture. @param picture `null`: none comes */
async function send(stage: Stage, picture: Picture | null): Promise<void> {
  if (picture !== null) await stage.video(NAME, { ...SIZE, ageMs: AGE_MS, ...picture });
  await stage.cloud('depth-room', { ageMs: AGE_MS });
  await stage.frames(3);
}

/** Such clouds come until what was before them does not count any more. */
async function show(stage: Stage, picture: Picture | null): Promise<void> {
  await send(stage, picture);
  // Without drawing, which takes a software renderer long.
  await stage.freeze();
  await stage.run(MEAN_MS);
  await stage.thaw();
  await send(stage, picture);
}

const stateOf = async (stage: Stage) => (await stage.stats()).videoColour?.state;

/** The colours in directions of the camera, each of one pixel: tangents to the right and down. */
async function colours(stage: Stage, places: readonly (readonly [right: number, down: number])[]) {
  const pixels = await stage.pixels();
  const found: (Rgb | undefined)[] = [];
  for (const [right, down] of places) {
    const { x, y, width, height } = await screenPlace(stage, { right, down });
    const [column, row] = [(x + width / 2) * CANVAS.width, (y + height / 2) * CANVAS.height];
    found.push(pixels[Math.floor(row) * CANVAS.width + Math.floor(column)]);
  }
  return found;
}

test('each picture paints the surface of its own instant, at its own place; without it, the packets’ colours are there', async ({
  stage,
}) => {
  const options = { canvas: CANVAS_SIZE, query: { every: '1' }, stored: SURFACES_ALONE };
  const page = await stage.open({ state: 'still', ...options });
  await offer(stage);
  // On the wall, on the box, and on the floor.
  const places = [
    [0.3, -0.1],
    [0, 0.35],
    [-0.3, 0.5],
  ] as const;
  await show(stage, null);
  const own = await colours(stage, places);
  const isGrey = (levels: Rgb = BLUE) => Math.max(...levels) - Math.min(...levels) < 3;
  expect(own.map((each) => isGrey(each))).toEqual([true, false, true]);
  expect(await stateOf(stage)).toBe('no-picture');

  await show(stage, { colour: WHITE });
  expect(await stateOf(stage)).toBe('painted');
  expect(await stage.share(WHITE, WALL, 1)).toBe(1);
  await show(stage, { quarters: [RED, GREEN, BLUE, WHITE] });
  const near = [
    [-0.06, -0.06],
    [0.06, -0.06],
    [-0.06, 0.06],
    [0.06, 0.06],
    [-0.6, -0.4],
    [0.6, -0.4],
    [-0.6, 0.5],
    [0.6, 0.5],
  ] as const;
  expect(await colours(stage, near)).toEqual([RED, GREEN, BLUE, WHITE, RED, GREEN, BLUE, WHITE]);

  // It was captured at another time, or with another lens.
  await show(stage, { colour: WHITE, ageMs: AGE_MS + 2 });
  expect(await colours(stage, places)).toEqual(own);
  await show(stage, { colour: WHITE, width: 320 });
  expect(await colours(stage, places)).toEqual(own);
  expect(await stateOf(stage)).toBe('no-match');

  // One that comes later than its cloud paints it, too.
  await stage.cloud('depth-room', { ageMs: AGE_MS });
  await stage.run(20);
  await stage.video(NAME, { ...SIZE, colour: RED, ageMs: AGE_MS + 20 });
  await stage.run(BLENDED_MS);
  expect((await stage.stats()).videoColour).toMatchObject({ use: 'matched' });
  expect(await colours(stage, places)).toEqual([RED, RED, RED]);

  await page.getByRole('button', { name: 'Colours', exact: true }).click();
  const button = page.getByRole('button', { name: 'Video', exact: true });
  await expect(button).toHaveAttribute('aria-pressed', 'true');
  await button.click();
  // It fades from what is drawn, and the clouds that come then are not painted.
  await stage.run(BLENDED_MS);
  expect(await colours(stage, places)).toEqual(own);
  await show(stage, { colour: WHITE });
  expect(await stateOf(stage)).toBe('switched-off');
  expect(await colours(stage, places)).toEqual(own);
  await button.click();
  await show(stage, { colour: WHITE });
  expect(await stateOf(stage)).toBe('painted');
  expect(await stage.share(WHITE, WALL, 1)).toBe(1);

  // Nobody watches the video: it stops, and the next clouds have the packets' colours.
  await page.getByRole('button', { name: `Hide ${NAME}` }).click();
  await show(stage, { colour: WHITE });
  expect(await stateOf(stage)).toBe('not-watched');
  expect(await colours(stage, places)).toEqual(own);
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('both eyes see the surface in the video’s colours', async ({ stage }) => {
    const options = { canvas: CANVAS_SIZE, query: { every: '1' }, stored: SURFACES_ALONE };
    await enterVr(stage, { state: 'still', ...options });
    await offer(stage);
    const shares = async (colour: Rgb) => {
      const ofEye = (x: number) => stage.share(colour, { x, y: 0.4, width: 0.2, height: 0.2 }, 1);
      return [await ofEye(0.15), await ofEye(0.65)];
    };
    for (let i = 0; i < 2; i++) await send(stage, null);
    expect(await shares(RED)).toEqual([0, 0]);
    for (let i = 0; i < 3; i++) await send(stage, { colour: RED });
    expect(await stateOf(stage)).toBe('painted');
    expect(await shares(RED)).toEqual([1, 1]);
  });
});
