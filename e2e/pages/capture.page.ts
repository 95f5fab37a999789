/** Pictures of the view, and clips of its last 30 seconds, saved as files that a browser shows. */
import { readFileSync } from 'node:fs';
import type { Download, Page } from '@playwright/test';
import { expect, test } from '../src/stage/page-test.ts';

const VIEW = { width: 640, height: 360 };
test.use({ viewport: VIEW });

interface Shown {
  width: number;
  height: number;
  /** How long it is, seconds; 0 for a picture. */
  duration: number;
  /** How much the brightness differs from place to place, 0–255: in all of it but the caption, and in the caption. */
  contrast: number;
  captionContrast: number;
}

/** Shows a file in a page of its own, as whoever gets it would; a video at its last picture. */
async function show(page: Page, download: Download, type: string): Promise<Shown> {
  const base64 = readFileSync(await download.path()).toString('base64');
  const reader = await page.context().newPage();
  const shown = await reader.evaluate(
    async ([base64, type]): Promise<Shown> => {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const file = new Blob([bytes], { type });
      let picture: CanvasImageSource;
      let [width, height, duration] = [0, 0, 0];
      if (type.startsWith('video')) {
        const video = document.createElement('video');
        video.muted = true;
        const happens = (event: string) =>
          new Promise((resolve, reject) => {
            video.addEventListener(event, resolve, { once: true });
            video.addEventListener('error', () => reject(new Error(video.error?.message)), { once: true });
          });
        const loaded = happens('loadeddata');
        video.src = URL.createObjectURL(file);
        await loaded;
        ({ videoWidth: width, videoHeight: height, duration } = video);
        document.body.append(video);
        // It has been sought before its picture can be read.
        const presented = new Promise((resolve) => video.requestVideoFrameCallback(resolve));
        const sought = happens('seeked');
        video.currentTime = Math.max(0, duration - 0.05);
        await Promise.all([sought, presented]);
        picture = video;
      } else {
        const bitmap = await createImageBitmap(file);
        ({ width, height } = bitmap);
        picture = bitmap;
      }
      const context = new OffscreenCanvas(width, height).getContext('2d')!;
      context.drawImage(picture, 0, 0);
      const contrastOf = (top: number, rows: number, across: number) => {
        const { data } = context.getImageData(0, top, across, rows);
        const greens = Array.from({ length: across * rows }, (_, i) => data[i * 4 + 1] as number);
        const mean = greens.reduce((sum, green) => sum + green, 0) / greens.length;
        return Math.sqrt(greens.reduce((sum, green) => sum + (green - mean) ** 2, 0) / greens.length);
      };
      const foot = 30;
      return {
        width,
        height,
        duration,
        contrast: contrastOf(0, height - foot, width),
        captionContrast: contrastOf(height - foot, foot, Math.floor(width / 3)),
      };
    },
    [base64, type] as const,
  );
  await reader.close();
  await page.bringToFront();
  return shown;
}

test('a picture has what is seen, and says when and of which robot', async ({ stage }) => {
  const page = await stage.open({ state: 'videos', canvas: 'full', forMs: 2000 });
  const saving = page.waitForEvent('download');
  await page.keyboard.press('KeyO');
  await stage.frames(3);
  const download = await saving;
  expect(download.suggestedFilename()).toMatch(/^farpoint-picture-.*\.png$/);
  const picture = await show(page, download, 'image/png');
  expect(picture).toMatchObject(VIEW);
  expect(picture.contrast).toBeGreaterThan(5);
  expect(picture.captionContrast).toBeGreaterThan(20);
  await expect(page.locator('#notice')).toHaveText('A picture of the view was saved.');
});

test('a clip has what was seen; without the setting none is kept, and no code for it is loaded', async ({
  stage,
}) => {
  const loaded: string[] = [];
  stage.page.on('request', (request) => loaded.push(request.url()));
  const page = await stage.open({ canvas: 'full' });
  await page.keyboard.press('KeyU');
  await expect(page.locator('#notice')).toHaveText(/^No clip is kept: switch on/);
  expect(loaded.filter((url) => /clip/.test(url))).toEqual([]);

  await page.locator('#settings-open').click();
  await page.getByLabel(/^Keep the last 30 s/).check();
  // Its code is loaded now.
  const recorder = page.waitForResponse(/clip-recorder/).then((response) => response.finished());
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await recorder;
  await stage.run(4000);
  const saving = page.waitForEvent('download');
  await page.keyboard.press('KeyU');
  const download = await saving;
  expect(download.suggestedFilename()).toMatch(/^farpoint-clip-.*\.webm$/);
  const clip = await show(page, download, 'video/webm');
  expect(clip).toMatchObject(VIEW);
  expect(clip.duration).toBeGreaterThan(1.5);
  expect(clip.duration).toBeLessThan(33);
  expect(clip.contrast).toBeGreaterThan(5);
  expect(clip.captionContrast).toBeGreaterThan(20);
  await expect(page.locator('#notice')).toHaveText(/^A clip of \d s was saved\.$/);
});
