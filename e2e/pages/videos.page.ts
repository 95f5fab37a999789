/** A robot's videos: which pictures are shown together, and what the page says of each camera. */
import type { Videos } from '@farpoint/protocol';
import { expect, test } from '../src/stage/page-test.ts';
import { FRAME_MS, type Stage } from '../src/stage/stage.ts';
import { coloursOf, panelOf, videoOf, videosOf } from '../src/stage/videos.ts';

const EVERY_MS = 100;
/** Of a picture that tells its number by its colour, per picture. */
const RED = 5;

/** The robot has these videos, some of them with what is wrong with them. */
function list(...cameras: readonly (readonly [name: string, fault?: string])[]): Videos {
  const videos = cameras.map(([name, fault], i) => {
    const video = { name, mid: `v${i}`, codec: 'VP8' as const };
    return fault === undefined ? video : { ...video, fault };
  });
  return { type: 'videos', videos };
}

/** Steps through display frames. @returns the numbers of the pictures that were shown together, each only once */
async function shownIn(stage: Stage, frames: number): Promise<number[][]> {
  const shown: number[][] = [];
  let first = Number.NaN;
  for (let frame = 0; frame < frames; frame++) {
    await stage.frames(1);
    const numbers = (await coloursOf(stage)).map(([red]) => red / RED);
    if (String(numbers) !== String(shown.at(-1))) shown.push(numbers);
    // What the page knows of a picture is what is drawn in it.
    for (const [i, { captureMs }] of (await videosOf(stage)).entries()) {
      const startMs = (captureMs ?? Number.NaN) - (numbers[i] ?? 0) * EVERY_MS;
      if (frame === 0 && i === 0) first = startMs;
      expect(startMs).toBe(first);
    }
  }
  return shown;
}

test('cameras are shown in step, each picture with its own time; none waits for one that is far behind', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'still', canvas: '64x36', frameMs: FRAME_MS });
  await stage.tell(list(['Front'], ['Left'], ['Right']));
  await stage.script((stage) =>
    stage.play({ Front: { delayMs: 10 }, Left: { delayMs: 25 }, Right: { delayMs: 40, lacks: [18] } }),
  );
  await stage.run(1490);
  // A picture that Right has not taken is waited for until the next is there, and no longer.
  expect(await shownIn(stage, 50)).toEqual([
    ...[13, 14, 15, 16, 17].map((number) => [number, number, number]),
    [18, 18, 17],
    ...[19, 20, 21].map((number) => [number, number, number]),
  ]);
  const report = page.locator('.video-report');
  await report.getByRole('button').click();
  await stage.run(300);
  await expect(report.getByRole('button')).toHaveText('In step within 0 ms');
  const lines = () => report.locator('dt, dd').allTextContents();
  expect(await lines()).toEqual([
    ...['Front', 'in step', 'Left', 'in step'],
    ...['Right', expect.stringMatching(/^in step · waited for in vain 1× \(\d\.\d %\)$/)],
  ]);

  // So late that its next picture comes before: it is shown by itself, and delays nobody.
  await stage.script((stage) =>
    stage.play({ Front: { delayMs: 10 }, Left: { delayMs: 25 }, Right: { delayMs: 350 } }),
  );
  await stage.run(2500);
  await stage.page.evaluate(() => window.farpoint.resetStats());
  await stage.run(1000);
  expect(await lines()).toEqual([
    ...['Front', 'in step', 'Left', 'in step'],
    ...['Right', expect.stringMatching(/^by itself/)],
  ]);
  const numbers = (await coloursOf(stage)).map(([red]) => red / RED);
  expect(numbers[1]).toBe(numbers[0]);
  expect((numbers[0] ?? 0) - (numbers[2] ?? 0)).toBe(3);
  // Until the display frame after the later one of the two has come.
  const [front, left] = (await stage.stats()).videos.videos.map(({ ageMs }) => ageMs?.max);
  expect(front).toBe(left);
  expect(front).toBeGreaterThanOrEqual(25);
  expect(front).toBeLessThanOrEqual(25 + FRAME_MS);
});

test('each panel says whether its camera is live, waiting, faulty, frozen or off, and how old its picture is', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'still', canvas: '64x36' });
  const panel = (name: string) => panelOf(page, name);
  const age = (name: string) => panel(name).locator('.age');
  const picture = (name: string) => panel(name).locator('canvas');
  /** A picture's age is that of its capture, at the page's last look: at most 250 ms ago. */
  const ageOf = async (name: string) => {
    await stage.run(250);
    const { ageMs, captureMs } = await videoOf(stage, name);
    const nowMs = await stage.script(({ robot }) => robot.nowMs);
    const looked = (captureMs ?? Number.NaN) + (ageMs ?? Number.NaN);
    expect(nowMs - looked).toBeGreaterThanOrEqual(0);
    expect(nowMs - looked).toBeLessThanOrEqual(250);
    return ageMs ?? Number.NaN;
  };
  const seconds = (ms: number) => `${(ms / 1000).toFixed(1)} s`;
  await stage.tell(list(['Front'], ['Rear'], ['Arm', 'there is no /dev/no-such-camera'], ['Odd']));
  await stage.run(300);
  await expect(panel('Front')).toHaveAttribute('data-state', 'waiting');
  await expect(age('Front')).toHaveText('waiting');
  await expect(picture('Front')).toBeHidden();
  await expect(panel('Arm')).toHaveAttribute('data-state', 'fault');
  await expect(age('Arm')).toHaveText('no picture');
  await expect(panel('Arm').locator('.fault')).toHaveText('there is no /dev/no-such-camera');
  await expect(picture('Arm')).toBeHidden();
  // A browser refuses a video by ending its track.
  await stage.script((stage) => stage.refuseVideo('Odd'));
  await stage.run(300);
  await expect(panel('Odd')).toHaveAttribute('data-state', 'fault');
  await expect(panel('Odd').locator('.fault')).toHaveText('This browser cannot decode this video.');
  await expect(panel('Front')).toHaveAttribute('data-state', 'waiting');

  await stage.video('Front', { colour: [200, 40, 10], ageMs: 400 });
  await expect(panel('Front')).toHaveAttribute('data-state', 'waiting');
  await stage.frames(1);
  expect((await coloursOf(stage))[0]).toEqual([200, 40, 10]);
  const first = await ageOf('Front');
  expect(first).toBeGreaterThanOrEqual(400);
  await expect(panel('Front')).toHaveAttribute('data-state', 'live');
  await expect(age('Front')).toHaveText(`${Math.round(first / 10) * 10} ms`);

  await stage.script((stage) => stage.play({ Front: { delayMs: 30 }, Rear: { delayMs: 50 } }));
  await stage.run(1000);
  await expect(picture('Rear')).toHaveCSS('filter', 'none');
  // One that is hidden is not taken, and the other goes on.
  await page.getByRole('button', { name: 'Hide Rear' }).click();
  await stage.run(300);
  await expect(panel('Rear')).toHaveAttribute('data-state', 'off');
  await expect(age('Rear')).toHaveText('hidden');
  await expect(picture('Rear')).toBeHidden();
  expect((await stage.sent('videos')).at(-1)?.videos).toEqual([0, 2, 3]);
  expect(await stage.video('Rear')).toBe(false);
  const before = await videosOf(stage);
  await stage.run(1000);
  const after = await videosOf(stage);
  expect(after.map(({ frames }, i) => frames - (before[i]?.frames ?? 0))).toEqual([10, 0, 0, 0]);
  await page.getByRole('button', { name: 'Show Rear' }).click();
  await stage.run(1000);
  await expect(panel('Rear')).toHaveAttribute('data-state', 'live');
  await expect(picture('Rear')).toBeVisible();

  // A camera that has ended: its last picture, without colours, and how old it is.
  await stage.script((stage) => stage.play({ Front: { delayMs: 30 } }));
  await stage.tell(list(['Front'], ['Rear', 'the camera was unplugged'], ['Arm'], ['Odd']));
  await expect(panel('Rear')).toHaveAttribute('data-state', 'fault');
  await expect(age('Rear')).toHaveText(`fault, ${seconds(await ageOf('Rear'))}`);
  await expect(panel('Rear').locator('.fault')).toHaveText('the camera was unplugged');
  await expect(picture('Rear')).toHaveCSS('filter', /grayscale/);
  await expect(panel('Arm')).toHaveAttribute('data-state', 'waiting');
  await expect(panel('Front')).toHaveAttribute('data-state', 'live');

  // Nothing comes any more, and nobody says so.
  await stage.script((stage) => stage.cut());
  await stage.run(900);
  await expect(panel('Front')).toHaveAttribute('data-state', 'live');
  await stage.run(600);
  await expect(panel('Front')).toHaveAttribute('data-state', 'frozen');
  await expect(age('Front')).toHaveText(`frozen, ${seconds(await ageOf('Front'))}`);
  await expect(picture('Front')).toHaveCSS('filter', /grayscale/);
  // Also where the camera fills the screen.
  await page.keyboard.press('KeyF');
  await expect(page.locator('#camera-stage p')).toHaveText(
    `Front · frozen, ${seconds(await ageOf('Front'))}`,
  );
  await expect(page.locator('#camera-stage canvas')).toHaveCSS('filter', /grayscale/);
  await stage.script((stage) => stage.restore());
  await stage.run(600);
  await expect(page.locator('#camera-stage p')).toHaveText(/^Front · \d+ ms$/);
  await expect(page.locator('#camera-stage canvas')).toHaveCSS('filter', 'none');
});
