/** A newcomer at the keyboard: drives about with Space, W, A and D, turns away from what is in the way, and lets go where told. */

import type { Page } from '@playwright/test';
import { OF_GUARDS } from './first-drive-figures.ts';

const LOOKS_MS = 250;
/** From time to time it steers, and after being stopped it turns for so long, ms. */
const STEERS_EVERY_MS = 5000;
const STEERS_MS = 700;
const TURNS_MS = 1500;
const OPENS_MS = 400;

const GRIP = 'Space';
const AHEAD = 'KeyW';
const LEFT = 'KeyA';
const RIGHT = 'KeyD';

/** Drives about for a while, and lets go. Real key presses. */
export async function driveAbout(page: Page, ms: number): Promise<void> {
  const { keyboard } = page;
  const down = new Set<string>();
  const hold = async (...keys: string[]): Promise<void> => {
    for (const key of [...down].filter((each) => !keys.includes(each))) {
      await keyboard.up(key);
      down.delete(key);
    }
    for (const key of keys.filter((each) => !down.has(each))) {
      await keyboard.down(key);
      down.add(key);
    }
  };
  const ofGuards = [...OF_GUARDS];
  const beganMs = performance.now();
  let steersMs = beganMs + STEERS_EVERY_MS;
  let turn = LEFT;
  await hold(GRIP, AHEAD);
  for (;;) {
    await page.waitForTimeout(LOOKS_MS);
    const nowMs = performance.now();
    if (nowMs - beganMs >= ms) break;
    const { blocked, mustOpen } = await page.evaluate((ofGuards) => {
      const newest = window.farpoint.recordedDrive()?.rows.at(-1);
      const { gripLost } = window.farpoint.state();
      const isGuard = (newest?.reasons ?? []).some((reason) => ofGuards.includes(reason));
      return {
        blocked: newest !== undefined && isGuard && newest.factor < 0.3,
        mustOpen: gripLost !== null || newest?.letGoFirst === true,
      };
    }, ofGuards);
    if (mustOpen) {
      await hold();
      await page.waitForTimeout(OPENS_MS);
      await hold(GRIP, AHEAD);
    } else if (blocked) {
      await hold(GRIP, turn);
      await page.waitForTimeout(TURNS_MS);
      await hold(GRIP, AHEAD);
      turn = turn === LEFT ? RIGHT : LEFT;
      // Away from the wall for good, rather than back to it.
      if (Math.floor((nowMs - beganMs) / 10_000) % 2 === 0) turn = LEFT;
    } else if (nowMs >= steersMs) {
      await hold(GRIP, AHEAD, turn);
      await page.waitForTimeout(STEERS_MS);
      await hold(GRIP, AHEAD);
      steersMs = performance.now() + STEERS_EVERY_MS;
    }
  }
  await hold();
}
