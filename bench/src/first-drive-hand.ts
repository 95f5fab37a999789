/** A newcomer's hand: drives about, turns away from what is in the way, and lets go where told. */
import type {} from '@farpoint/local-stack';
import type {} from '@farpoint/webxr/test-api';
import { OF_GUARDS } from './first-drive-figures.ts';

const LOOKS_MS = 250;
/** From time to time it steers, and after being stopped it turns for so long, ms. */
const STEERS_EVERY_MS = 5000;
const STEERS_MS = 700;
const TURNS_MS = 1500;
const OPENS_MS = 400;

/** What a hand can hold. */
export type Held = 'grip' | 'ahead' | 'left' | 'right';

/** Holds exactly this from now on. */
export type Hand = (...held: Held[]) => Promise<void>;

/** What Playwright's pages and those of WebDriver BiDi have in common. */
export interface DrivenPage {
  evaluate<Answer, Given>(ask: (given: Given) => Answer, given: Given): Promise<Awaited<Answer>>;
}

/** By key, as a browser calls them. */
const KEYS = { grip: 'Space', ahead: 'KeyW', left: 'KeyA', right: 'KeyD' } as const satisfies Record<
  Held,
  string
>;
export type DriveKey = (typeof KEYS)[Held];

/** Real key presses. */
export function handOnKeys(keyboard: {
  down(key: DriveKey): Promise<void>;
  up(key: DriveKey): Promise<void>;
}): Hand {
  const down = new Set<Held>();
  return async (...held) => {
    for (const each of [...down].filter((each) => !held.includes(each))) {
      await keyboard.up(KEYS[each]);
      down.delete(each);
    }
    for (const each of held.filter((each) => !down.has(each))) {
      await keyboard.down(KEYS[each]);
      down.add(each);
    }
  };
}

/** The right controller of an emulated headset (iwer): its squeeze button and thumbstick. */
export function handOnController(page: DrivenPage): Hand {
  return (...held) =>
    page.evaluate((held) => {
      const turn = Number(held.includes('right')) - Number(held.includes('left'));
      const controller = window.emulatedHeadset.controllers.right;
      controller?.updateButtonValue('squeeze', Number(held.includes('grip')));
      controller?.updateAxes('thumbstick', turn, held.includes('ahead') ? -1 : 0);
    }, held);
}

/** Drives about for a while, and lets go. */
export async function driveAbout(page: DrivenPage, hold: Hand, ms: number): Promise<void> {
  const ofGuards = [...OF_GUARDS];
  const beganMs = performance.now();
  let steersMs = beganMs + STEERS_EVERY_MS;
  let turn: Held = 'left';
  await hold('grip', 'ahead');
  for (;;) {
    await pause(LOOKS_MS);
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
      await pause(OPENS_MS);
      await hold('grip', 'ahead');
    } else if (blocked) {
      await hold('grip', turn);
      await pause(TURNS_MS);
      await hold('grip', 'ahead');
      turn = turn === 'left' ? 'right' : 'left';
      // Away from the wall for good, rather than back to it.
      if (Math.floor((nowMs - beganMs) / 10_000) % 2 === 0) turn = 'left';
    } else if (nowMs >= steersMs) {
      await hold('grip', 'ahead', turn);
      await pause(STEERS_MS);
      await hold('grip', 'ahead');
      steersMs = performance.now() + STEERS_EVERY_MS;
    }
  }
  await hold();
}

export function pause(ms: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, ms));
}
