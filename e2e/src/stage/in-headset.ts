import type { HeadsetProbe } from '@farpoint/webxr/test-api';
import { expect } from '@playwright/test';
import { Headset } from '../headset.ts';
import type { Stage, StageOptions } from './stage.ts';

/** Height of the emulated eyes, m. */
const EYES_M = 1.6;
/** Until the session and its first frames are there, display frames. */
const ENTERED = 20;

/** Opens the page with an emulated headset, and enters VR. @param settings as the browser keeps them */
export async function enterVr(
  stage: Stage,
  options: StageOptions = {},
  settings: Record<string, string | number> | null = null,
): Promise<Headset> {
  const headset = await Headset.wear(stage.page, (frames) => stage.frames(frames));
  if (settings !== null) await headset.settings(settings);
  await openInVr(stage, options);
  return headset;
}

/** Opens the page anew and enters VR with the headset that is worn already. @param frames after which it is there */
export async function openInVr(stage: Stage, options: StageOptions, frames = ENTERED): Promise<void> {
  const { page } = stage;
  await stage.open({ canvas: '64x36', ...options });
  await page.getByRole('button', { name: /VR/ }).click();
  await stage.frames(frames);
  if (!(await stage.state()).vr) throw new Error('the page has not entered VR');
}

/** What the headset's console shows, once its code has been loaded. */
export async function consoleIn(stage: Stage): Promise<NonNullable<HeadsetProbe['console']>> {
  let { console } = await shownIn(stage);
  // The network has a clock of its own.
  await expect.poll(async () => (console ??= (await shownIn(stage)).console)).not.toBeNull();
  if (console === null) throw new Error('the console is not loaded');
  return console;
}

/** What the headset shows. */
export async function shownIn(stage: Stage): Promise<HeadsetProbe> {
  const shown = await stage.page.evaluate(() => window.farpoint.headset());
  if (shown === null) throw new Error('not in VR');
  return shown;
}

/** The lines on the wrist. */
export function wristOf(stage: Stage): Promise<{ text: string; tone: string }[]> {
  return stage.page.evaluate(() => window.farpoint.wrist() ?? []);
}

/** Where an entry of the menu is in its list. */
function entryOf(entries: readonly string[], entry: string | RegExp): number {
  const at = entries.findIndex((text) => (typeof entry === 'string' ? text === entry : entry.test(text)));
  expect(at, `${entry} in ${entries.join(', ')}`).toBeGreaterThanOrEqual(0);
  return at;
}

/** Moves the mark to an entry of the menu by the stick, and pulls the trigger. */
export async function chooseBySteps(stage: Stage, headset: Headset, entry: string | RegExp): Promise<void> {
  const to = entryOf((await consoleIn(stage)).menu?.items ?? [], entry);
  for (let tries = 0; (await consoleIn(stage)).menu?.marked !== to; tries++) {
    expect(tries).toBeLessThan(20);
    await headset.thumbstick('right', 0, 1);
    await headset.frames(2);
    await headset.thumbstick('right', 0, 0);
    await headset.frames(2);
  }
  await headset.press('right', 'trigger');
}

/** Holds the right controller straight before an entry of the menu, and pulls the trigger. */
export async function chooseByRay(stage: Stage, headset: Headset, entry: string | RegExp): Promise<void> {
  const { menu } = await consoleIn(stage);
  const [x, y, z] = menu?.places[entryOf(menu.items, entry)] ?? [0, 0, 0];
  await headset.place('right', [x, y + EYES_M, z + 0.15]);
  await headset.frames(3);
  await headset.press('right', 'trigger');
}

/** Pinches at a place of the tracked space with the right bare hand. */
export async function pinchAt(
  headset: Headset,
  place: readonly [number, number, number] | undefined,
): Promise<void> {
  if (place === undefined) throw new Error('there is nothing to pinch');
  // What is tracked begins at the eyes. A little before it, the hand points straight at it.
  const [x, y, z] = place;
  for (const pinches of [0, 1, 0]) await headset.bareHand('right', [x, y + EYES_M, z + 0.15], pinches);
}

/** Counts what the right controller feels from now on. */
export async function countPulses({ page }: Stage): Promise<() => Promise<number>> {
  const counted = await page.evaluateHandle(() => {
    const pulses = { count: 0 };
    const actuator = window.emulatedHeadset.controllers.right?.inputSource.gamepad?.hapticActuators[0];
    if (actuator === undefined) throw new Error('the controller has nothing that vibrates');
    actuator.pulse = async () => {
      pulses.count++;
      return true;
    };
    return pulses;
  });
  return () => counted.evaluate(({ count }) => count);
}
