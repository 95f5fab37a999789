/** `pnpm bench picture`: the same view over the same link in each mode, side by side. */

import { writeFileSync } from 'node:fs';
import { BitRate } from '@farpoint/timing';
import { decode, encode } from 'fast-png';
import { benchOptions, option } from './bench-options.ts';
import { startLiveStack } from './live-stack.ts';
import { type Bench, printJson, printTable } from './report.ts';

const USAGE = `pnpm bench picture --out FILE.png [--rate-mbps 8] [--rtt-ms 42.4] [--fps 10] [--seconds 10] [--size 640x480] [--json]

Real robot (simulated office, standing), signaling and headless Chromium over an emulated link. The picture shows what the
operator sees after --seconds: left with points64, right with auto.`;

interface Picture {
  mode: string;
  pixels: Uint8Array;
  channels: number;
  pointsPerFrame: number;
  framesPerSecond: number;
  mbps: number;
}

interface View {
  rateMbps: number;
  rttMs: number;
  fps: number;
  seconds: number;
  width: number;
  height: number;
}

export const bench: Bench = {
  name: 'picture',
  summary: 'what an operator sees over a link: points64 compared with the whole cloud',
  usage: USAGE,
  async run(argv) {
    const { out, size, json, ...link } = benchOptions(argv, {
      out: option.text(),
      rateMbps: option.number(8, { least: 0.1 }),
      rttMs: option.number(42.4),
      fps: option.number(10),
      seconds: option.number(10, { least: 1 }),
      size: option.text('640x480'),
    });
    if (out === undefined) throw new Error('--out FILE.png is missing');
    const [width, height] = size.split('x').map(Number) as [number, number];
    if (!Number.isInteger(width) || !Number.isInteger(height)) throw new Error(`--size is \`${size}\``);
    const view = { ...link, width, height };
    const pictures: Picture[] = [];
    for (const mode of ['points64', 'auto']) pictures.push(await pictureIn(mode, view));
    writeFileSync(out, sideBySide(pictures, width, height));
    const rows = pictures.map(({ mode, pointsPerFrame, framesPerSecond, mbps }) => ({
      mode,
      pointsPerFrame: Math.round(pointsPerFrame),
      framesPerSecond: Number(framesPerSecond.toFixed(1)),
      mbps: Number(mbps.toFixed(2)),
    }));
    printTable(
      ['mode', 'points a frame', 'frames/s', 'Mbit/s'],
      rows.map((row) => [row.mode, row.pointsPerFrame, row.framesPerSecond, row.mbps]),
    );
    if (json) printJson({ bench: 'picture', rateMbps: link.rateMbps, out, rows });
  },
};

async function pictureIn(
  mode: string,
  { rateMbps, rttMs, fps, seconds, width, height }: View,
): Promise<Picture> {
  const live = await startLiveStack({
    robot: { id: 'sim-1', name: 'Simulated robot', args: ['--mode', mode, '--fps', String(fps)] },
    canvas: `${width}x${height}`,
    query: 'every=1',
    link: {
      args: ['--rate-mbps', String(rateMbps), '--rtt-ms', String(rttMs), '--queue-ms', '100'],
      env: { FARPOINT_LOG_LEVEL: 'warn' },
    },
    log: (line) => console.error(`${mode}: ${line}`),
  });
  try {
    await live.page.waitForTimeout(seconds * 1000);
    const { pointsPerFrame, framesPerSecond, bitsPerSecond } = await live.page.evaluate(() =>
      window.farpoint.stats(),
    );
    const png = await live.page.locator('canvas').first().screenshot({
      // Hide everything but the cloud: the page's elements are drawn over the canvas.
      style:
        'body > :not(canvas) { visibility: hidden !important } canvas { visibility: visible !important }',
    });
    const { data, channels, ...size } = decode(png);
    if (size.width !== width || size.height !== height)
      throw new Error(`the canvas is ${size.width}×${size.height}, not ${width}x${height}`);
    return {
      mode,
      pixels: Uint8Array.from(data),
      channels,
      pointsPerFrame,
      framesPerSecond,
      mbps: BitRate.toMbps(bitsPerSecond),
    };
  } finally {
    await live.close();
  }
}

const GAP = 8;

function sideBySide(pictures: readonly Picture[], width: number, height: number): Uint8Array {
  const total = pictures.length * width + (pictures.length - 1) * GAP;
  const data = new Uint8Array(total * height * 3).fill(255);
  for (const [i, { pixels, channels }] of pictures.entries()) {
    for (let y = 0; y < height; y++) {
      for (let x = 0; x < width; x++) {
        const from = (y * width + x) * channels;
        data.set(pixels.subarray(from, from + 3), (y * total + i * (width + GAP) + x) * 3);
      }
    }
  }
  return encode({ width: total, height, data, channels: 3, depth: 8 });
}
