/** The last 30 seconds of the scene, saved as a file that a browser plays. */
import { readFileSync } from 'node:fs';
import type { Download, Page } from '@playwright/test';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

const CANVAS = { width: 320, height: 180 };

interface Played {
  duration: number;
  width: number;
  height: number;
  /** How much the last picture's brightness differs from place to place, 0–255. */
  contrast: number;
}

/** Plays a file in a page of its own, as whoever gets it would. */
async function play(page: Page, download: Download): Promise<Played> {
  const bytes = readFileSync(await download.path());
  // EBML, of which WebM is made.
  expect(bytes.subarray(0, 4).toString('hex')).toBe('1a45dfa3');
  const player = await page.context().newPage();
  const played = await player.evaluate(async (base64) => {
    const video = document.createElement('video');
    video.muted = true;
    const type = 'video/webm';
    const binary = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const happens = (event: string) =>
      new Promise((resolve, reject) => {
        video.addEventListener(event, resolve, { once: true });
        video.addEventListener('error', () => reject(new Error(video.error?.message)), { once: true });
      });
    const loaded = happens('loadeddata');
    video.src = URL.createObjectURL(new Blob([binary], { type }));
    await loaded;
    const { duration, videoWidth: width, videoHeight: height } = video;
    const sought = happens('seeked');
    video.currentTime = Math.max(0, duration - 0.2);
    await sought;
    const context = new OffscreenCanvas(width, height).getContext('2d')!;
    context.drawImage(video, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    const greens = Array.from({ length: width * height }, (_, i) => data[i * 4 + 1] as number);
    const mean = greens.reduce((sum, green) => sum + green, 0) / greens.length;
    const contrast = Math.sqrt(greens.reduce((sum, green) => sum + (green - mean) ** 2, 0) / greens.length);
    return { duration, width, height, contrast };
  }, bytes.toString('base64'));
  await player.close();
  return played;
}

test('a clip has what was shown; without the setting none is kept', async ({ page, startStack }) => {
  const stack = await startStack({ robots: [lightRobot] });
  const { width, height } = CANVAS;
  const operator = await OperatorPage.open(page, stack, {
    ...{ robot: lightRobot.id, canvas: `${width}x${height}`, clips: '1' },
  });
  await operator.expectPoints(300);
  const before = (await operator.stats()).framesDrawn;
  // At ten clouds a second.
  await expect
    .poll(async () => (await operator.stats()).framesDrawn - before, { timeout: 30_000 })
    .toBeGreaterThan(40);
  const saving = page.waitForEvent('download');
  await page.keyboard.press('KeyJ');
  const download = await saving;
  expect(download.suggestedFilename()).toMatch(/^farpoint-clip-.*\.webm$/);
  await expect(page.locator('#notice')).toHaveText(/^A clip of the last \d+ seconds was saved\.$/);
  await page.bringToFront();
  const clip = await play(page, download);
  expect(clip).toMatchObject({ width, height });
  expect(clip.duration).toBeGreaterThan(3);
  expect(clip.duration).toBeLessThan(33);
  // A scene, and no empty sheet.
  expect(clip.contrast).toBeGreaterThan(5);

  await page.bringToFront();
  await page.locator('#settings-open').press('Enter');
  await page.getByLabel(/^Keep the last 30 seconds/).uncheck();
  await page.getByRole('button', { name: 'Save', exact: true }).press('Enter');
  await page.keyboard.press('KeyJ');
  await expect(page.locator('#notice')).toHaveText(/^Clips are off/);
});
