/** `pnpm bench view`: a kernel benchmark of what the operator sees, against what is truly there. */
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { setTimeout } from 'node:timers/promises';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { encode } from 'fast-png';
import { benchOptions, option } from './bench-options.ts';
import { type Bench, printJson, printTable } from './report.ts';
import { type Distribution, distribution, rounded } from './stats.ts';
import { compareColours, meanOf } from './view/colour-comparison.ts';
import { differenceOf, type Picture, type PictureDifference } from './view/picture-difference.ts';
import { type DriveOptions, EYES, SimulatedDrive } from './view/simulated-drive.ts';
import { ViewBrowser } from './view/view-browser.ts';

const USAGE = `pnpm bench view [--rate-mbps 8] [--loss 0.01] [--fps 10] [--seconds 20] [--size 320] [--seed 1]
               [--pictures DIR] [--json]
       pnpm bench view --video [--video-mbps 1.5] [--colour-quality 31] [--rate-mbps 8] [--loss 0.01] [--fps 10]
               [--seconds 20] [--json]

Kernel benchmark: a simulated robot drives among furniture and walking people, and its packets, as a link of this rate
and loss delivers them, are decoded and drawn in a headless Chromium without a GPU. From the tenth second on, once a
second, what an eye in the camera's place sees, and one above and behind the robot, is compared with what is truly
there: holes is the share of pixels that should show something and show nothing, ssim the similarity of brightness,
depthErrorM the median error. Drawn as surfaces with the remembered world behind them, as surfaces alone, as discs (the
same packets), and as the reference system's points (points64, sampled, at the same rate). --pictures writes the last
second's pictures, one PNG file for each eye: truth, memory, surface, discs, reference.

--video compares what paints the surface at the same total rate: the packets' own colours, or the depth camera's
picture as a video, encoded by GStreamer, while packets have coarse colours and depth gets the rest. whole is the
share of frames in which every point was sent. Lost packets of the video are taken to be sent again. Needs GStreamer and
\`pnpm build:native video\`.`;

/** What is compared: how the robot codes its clouds, and how they are drawn. */
const MODES = [
  { name: 'memory', format: 'organised', surface: true, memory: true },
  { name: 'surface', format: 'organised', surface: true, memory: false },
  { name: 'discs', format: 'organised', surface: false, memory: false },
  { name: 'reference', format: 'points64', surface: false, memory: false },
] as const;

/** Before, the memory is still being filled. */
const FROM_S = 10;

interface ModeResult {
  /** By eye, means over all looks. */
  eyes: Record<string, PictureDifference>;
  drawMs: Distribution;
  /** Time of a cloud frame on the page's main thread, without decoding and drawing, ms. */
  mainThreadMs: Distribution;
}

const OPTIONS = {
  rateMbps: option.number(8, { least: 0.1 }),
  loss: option.number(0.01),
  fps: option.number(10, { least: 1 }),
  seconds: option.number(20, { least: FROM_S + 1 }),
  size: option.number(320, { least: 32 }),
  seed: option.number(1),
  pictures: option.text(),
  video: option.flag,
  videoMbps: option.number(1.5, { least: 0.1 }),
  colourQuality: option.number(31),
};

export const bench: Bench = {
  name: 'view',
  summary: 'kernel: holes, similarity and depth error of what the operator sees, by renderer',
  usage: USAGE,
  async run(argv) {
    const options = benchOptions(argv, OPTIONS);
    const { rateMbps, loss, fps: framesPerSecond, seed, size, seconds, json } = options;
    const drive: DriveOptions = { rateMbps, loss, framesPerSecond, seed, size };
    const { videoMbps, colourQuality: quality } = options;
    if (options.video) return compareColours({ ...drive, videoMbps, quality, seconds, json });
    const { results, last } = await compareModes(drive, seconds);
    if (options.pictures !== undefined) writePictures(options.pictures, last, drive.size);
    printTable(
      ['', 'holes', 'ssim', 'depth error m', 'behind: holes', 'ssim', 'draw ms p50', 'main ms p50'],
      Object.entries(results).map(([name, { eyes, drawMs, mainThreadMs }]) => {
        const [eye, shoulder] = [eyes.eye, eyes.shoulder] as [PictureDifference, PictureDifference];
        const ofEye = [eye.holes, eye.ssim, eye.depthErrorM];
        return [name, ...ofEye, shoulder.holes, shoulder.ssim, drawMs.p50, mainThreadMs.p50];
      }),
    );
    if (!json) return;
    const flat = Object.fromEntries(
      Object.entries(results).map(([name, { eyes, ...others }]) => {
        const { eye, shoulder } = eyes;
        return [name, { ...eye, shoulder, ...others }];
      }),
    );
    // As the page shows it where there is a GPU.
    const { memory, ...others } = flat;
    printJson({ bench: 'view', ...drive, seconds, ...memory, ...others });
  },
};

/** Drives once in each mode. @returns the results, and the last second's pictures by eye */
async function compareModes(options: DriveOptions, seconds: number) {
  const browser = await ViewBrowser.open();
  const results: Record<string, ModeResult> = {};
  const last: Picture[][] = EYES.map(() => []);
  try {
    for (const mode of MODES) {
      console.error(`${mode.name} …`);
      results[mode.name] = await drawn(browser, mode, options, seconds, last);
    }
  } finally {
    await browser.close();
  }
  return { results, last };
}

async function drawn(
  browser: ViewBrowser,
  { format, surface, memory }: (typeof MODES)[number],
  options: DriveOptions,
  seconds: number,
  last: Picture[][],
): Promise<ModeResult> {
  const { framesPerSecond, size } = options;
  // The same seed: every mode sees the same drive.
  const drive = await SimulatedDrive.create(await loadCodecFromDisk(), options);
  const header = format === 'organised' ? drive.streamHeader : null;
  await browser.begin(header, { surface, memory, size });
  const differences: PictureDifference[][] = EYES.map(() => []);
  const drawMs: number[] = [];
  const mainMs: number[] = [];
  const frames = Math.round(seconds * framesPerSecond);
  for (let frame = 1; frame <= frames; frame++) {
    const dueMs = performance.now() + 1000 / framesPerSecond;
    mainMs.push(await browser.feed(drive.next()[format]));
    // The memory keeps time.
    if (memory) await setTimeout(Math.max(dueMs - performance.now(), 0));
    if (frame < FROM_S * framesPerSecond || frame % Math.round(framesPerSecond) !== 0) continue;
    for (const [i, { pose, picture: truth }] of drive.truth().entries()) {
      const eye = EYES[i] as (typeof EYES)[number];
      const seen = await browser.look(pose, eye.fieldOfView);
      differences[i]?.push(differenceOf(seen.picture, truth, size));
      if (i === 0) drawMs.push(seen.drawMs);
      if (frame + framesPerSecond <= frames) continue;
      const pictures = last[i] as Picture[];
      if (pictures.length === 0) pictures.push(truth);
      pictures.push(seen.picture);
    }
  }
  drive.close();
  const eyes = Object.fromEntries(EYES.map((eye, i) => [eye.name, meanOf(differences[i] ?? [])]));
  const times = { drawMs: distribution(drawMs), mainThreadMs: distribution(mainMs) };
  return { eyes, drawMs: rounded(times.drawMs), mainThreadMs: rounded(times.mainThreadMs) };
}

/** Side by side, a file for each eye. */
function writePictures(folder: string, last: readonly (readonly Picture[])[], size: number): void {
  mkdirSync(folder, { recursive: true });
  for (const [i, pictures] of last.entries()) {
    const width = size * pictures.length;
    const data = new Uint8Array(width * size * 4).fill(255);
    for (const [place, { colour }] of pictures.entries()) {
      for (let pixel = 0; pixel < size * size; pixel++) {
        const at = (Math.floor(pixel / size) * width + place * size + (pixel % size)) * 4;
        for (let channel = 0; channel < 3; channel++)
          data[at + channel] = colour[pixel * 4 + channel] as number;
      }
    }
    const file = join(folder, `${EYES[i]?.name}.png`);
    writeFileSync(file, encode({ width, height: size, data, channels: 4 }));
  }
}
