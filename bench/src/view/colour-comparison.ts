/** Compares what paints the surface at the same rate: the packets’ own colours, or the depth camera’s video. */
import { BitRate } from '@farpoint/timing';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { printJson, printTable } from '../report.ts';
import { differenceOf, type PictureDifference } from './picture-difference.ts';
import { PictureVideo } from './picture-video.ts';
import { type DriveOptions, EYES, SimulatedDrive } from './simulated-drive.ts';
import { ViewBrowser } from './view-browser.ts';

export interface ComparisonOptions extends DriveOptions {
  /** Of the rate, what the video gets, Mbit/s. */
  videoMbps: number;
  /** Of the packets' colours beside a video, 0 to 31 (coarsest). */
  quality: number;
  seconds: number;
  json: boolean;
}

/** Frames a second, as a factor of the option, and whether a video paints. */
const MODES = [
  { name: 'packets', faster: 1, video: false },
  { name: 'video', faster: 1, video: true },
  { name: 'packets 1.5×', faster: 1.5, video: false },
  { name: 'video 1.5×', faster: 1.5, video: true },
  { name: 'video 2×', faster: 2, video: true },
] as const;

interface Outcome {
  framesPerSecond: number;
  /** Of the frames, how many had every point, 0–1. */
  whole: number;
  /** Mean; depth errors are at most 0.0625 · 2^level mm · z². */
  depthLevel: number;
  /** What the video took, Mbit/s. */
  videoMbps: number;
  /** Means over all looks, by eye. */
  eyes: Record<string, PictureDifference>;
}

/** Prints a row for each mode. @throws {Error} without GStreamer */
export async function compareColours(options: ComparisonOptions): Promise<void> {
  const browser = await ViewBrowser.open();
  const outcomes: Record<string, Outcome> = {};
  try {
    for (const { name, faster, video } of MODES) {
      console.error(`${name} …`);
      const framesPerSecond = options.framesPerSecond * faster;
      outcomes[name] = await drawn(browser, { ...options, framesPerSecond }, video);
    }
  } finally {
    await browser.close();
  }
  printTable(
    ['', 'frames/s', 'whole', 'depth level', 'video Mbit/s', 'ssim', 'depth error m', 'behind: ssim'],
    Object.entries(outcomes).map(([name, outcome]) => {
      const { framesPerSecond, whole, depthLevel, videoMbps, eyes } = outcome;
      const [eye, shoulder] = [eyes.eye, eyes.shoulder] as [PictureDifference, PictureDifference];
      return [name, framesPerSecond, whole, depthLevel, videoMbps, eye.ssim, eye.depthErrorM, shoulder.ssim];
    }),
  );
  if (options.json) printJson({ bench: 'view', comparison: 'video-colour', ...options, ...outcomes });
}

async function drawn(browser: ViewBrowser, options: ComparisonOptions, painted: boolean): Promise<Outcome> {
  const { framesPerSecond, size, seconds, rateMbps, videoMbps, quality } = options;
  const cloudMbps = painted ? rateMbps - videoMbps : rateMbps;
  // The same seed: every mode sees the same drive.
  const drive = await SimulatedDrive.create(await loadCodecFromDisk(), {
    ...options,
    rateMbps: cloudMbps,
    colourQuality: painted ? quality : undefined,
  });
  const video = painted ? await PictureVideo.open(BitRate.fromMbps(videoMbps), framesPerSecond) : null;
  await browser.begin(drive.streamHeader, { surface: true, memory: false, size });
  const differences: PictureDifference[][] = EYES.map(() => []);
  const frames = Math.round(seconds * framesPerSecond);
  let [whole, levels] = [0, 0];
  for (let frame = 1; frame <= frames; frame++) {
    const { organised, picture, whole: isWhole, depthLevel } = drive.next();
    if (video !== null) await browser.paint(await video.encode(picture));
    await browser.feed(organised);
    whole += Number(isWhole);
    levels += depthLevel;
    if (frame < framesPerSecond || frame % Math.round(framesPerSecond) !== 0) continue;
    for (const [i, { pose, picture: truth }] of drive.truth().entries()) {
      const eye = EYES[i] as (typeof EYES)[number];
      const seen = await browser.look(pose, eye.fieldOfView);
      differences[i]?.push(differenceOf(seen.picture, truth, size));
    }
  }
  drive.close();
  await video?.close();
  const round = (value: number, digits = 3) => Number(value.toFixed(digits));
  return {
    framesPerSecond,
    whole: round(whole / frames),
    depthLevel: round(levels / frames, 1),
    videoMbps: round(((video?.bytes ?? 0) * 8) / seconds / 1e6),
    eyes: Object.fromEntries(EYES.map((eye, i) => [eye.name, meanOf(differences[i] ?? [])])),
  };
}

/** Of each figure. */
export function meanOf(all: readonly PictureDifference[]): PictureDifference {
  const mean = (of: (each: PictureDifference) => number) =>
    Number((all.reduce((sum, each) => sum + of(each), 0) / all.length).toFixed(4));
  return {
    holes: mean(({ holes }) => holes),
    ssim: mean(({ ssim }) => ssim),
    depthErrorM: mean(({ depthErrorM }) => depthErrorM),
  };
}
