/** Watches, while a page drives, whether the video paints, and why it does not. */
import type {} from '@farpoint/webxr/test-api';
import type { Page } from '@playwright/test';

export interface Painting {
  /** Of the clouds that a newer one followed, the share that the video painted by then, 0–1. */
  painted: number;
  /** Of the colours that were drawn, the share that the video gave, mean, 0–1. */
  shown: number;
  /** How long clouds were held for their pictures, median, ms; `null` without the video. */
  heldMs: number | null;
  /** From capture to display, of clouds, median, ms. */
  cloudAgeMs: number | null;
  /** Share of the time for which the page claimed that the video paints, 0–1. */
  claimed: number;
  /** How often the page said what state the colours are in, e.g. `painted`, `late`. */
  states: Record<string, number>;
  /** What became of the video's pictures, by use. */
  pictures: Record<string, number>;
  /** From capture to display, median, ms; `null` without the video. */
  pictureAgeMs: number | null;
}

const EVERY_MS = 200;

/** @param drive runs meanwhile */
export async function watchPainting(page: Page, drive: () => Promise<unknown>): Promise<Painting> {
  const look = () =>
    page.evaluate(() => {
      const { videoColour, videos, frameLatencyMs } = window.farpoint.stats();
      return {
        colour: videoColour ?? null,
        ageMs: videos.videos[0]?.ageMs?.p50 ?? null,
        cloudAgeMs: frameLatencyMs?.p50 ?? null,
      };
    });
  const { colour: before } = await look();
  const states: Record<string, number> = {};
  let [looks, claims, shares] = [0, 0, 0];
  const driven = { over: false };
  const driving = drive().finally(() => {
    driven.over = true;
  });
  while (!driven.over) {
    const { colour } = await look();
    if (colour !== null) {
      looks++;
      shares += colour.share;
      if (colour.claimed.length > 0) claims++;
      states[colour.state] = (states[colour.state] ?? 0) + 1;
    }
    await Promise.race([driving, page.waitForTimeout(EVERY_MS)]);
  }
  await driving;
  const { colour: after, ageMs, cloudAgeMs } = await look();
  const followed = (after?.clouds.followed ?? 0) - (before?.clouds.followed ?? 0);
  const painted = (after?.clouds.painted ?? 0) - (before?.clouds.painted ?? 0);
  const uses = Object.entries(after?.pictures ?? {});
  return {
    painted: followed === 0 ? 0 : painted / followed,
    shown: looks === 0 ? 0 : shares / looks,
    heldMs: after?.heldMs ?? null,
    cloudAgeMs,
    claimed: looks === 0 ? 0 : claims / looks,
    states,
    pictures: Object.fromEntries(
      uses.map(([use, count]) => [use, count - (before?.pictures[use as keyof typeof before.pictures] ?? 0)]),
    ),
    pictureAgeMs: ageMs,
  };
}
