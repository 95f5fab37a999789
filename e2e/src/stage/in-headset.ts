import type { HeadsetProbe } from '@farpoint/webxr/test-api';
import { expect } from '@playwright/test';
import { Headset } from '../headset.ts';
import type { Stage, StageOptions } from './stage.ts';

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
