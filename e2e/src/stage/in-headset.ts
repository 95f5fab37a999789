import type { HeadsetProbe } from '@farpoint/webxr/test-api';
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
  const { page } = stage;
  const headset = await Headset.wear(page, (frames) => stage.frames(frames));
  if (settings !== null) await headset.settings(settings);
  await stage.open({ canvas: '64x36', ...options });
  await page.getByRole('button', { name: /VR/ }).click();
  await stage.frames(ENTERED);
  if (!(await stage.state()).vr) throw new Error('the page has not entered VR');
  return headset;
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
