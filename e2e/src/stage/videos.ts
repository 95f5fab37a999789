/** What the page shows of a robot's videos. */
import type { VideoProbe } from '@farpoint/webxr/test-api';
import type { Locator, Page } from '@playwright/test';
import type { Rgb, Stage } from './stage.ts';

export function panelOf(page: Page, name: string): Locator {
  return page.locator('#pictures').getByRole('figure', { name, exact: true });
}

export function videosOf({ page }: Stage): Promise<VideoProbe[]> {
  return page.evaluate(() => window.farpoint.videos());
}

export async function videoOf(stage: Stage, name: string): Promise<VideoProbe> {
  const video = (await videosOf(stage)).find((each) => each.name === name);
  if (video === undefined) throw new Error(`the page has no video ${name}`);
  return video;
}

/** The colours of the videos' pictures in the middle of their left halves; black before the first. */
export function coloursOf({ page }: Stage): Promise<Rgb[]> {
  return page.evaluate(() =>
    window.farpoint.videos().map(({ width, height }, video): Rgb => {
      const context = window.farpoint.videoCanvas(video)?.getContext('2d');
      const [red = 0, green = 0, blue = 0] = context?.getImageData(width / 4, height / 2, 1, 1).data ?? [];
      return [red, green, blue];
    }),
  );
}
