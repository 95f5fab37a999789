/** `pnpm bench pictures`: a kernel benchmark of how the robot processes a camera's picture. */
import { PictureCodec, ShrinkingFilter } from '@farpoint/pictures';
import { pictureRows } from '@farpoint/ros';
import { Simulation } from '@farpoint/sim';
import { benchOptions, option } from './bench-options.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { distribution, rounded, timeCalls } from './stats.ts';

const USAGE = `pnpm bench pictures [--width 640] [--height 480] [--quality 70] [--rounds 200] [--json]

Kernel benchmark, in one process, with a picture of the simulated camera: writes and reads a JPEG, and turns a raw bgr8 image
of that size into JPEGs at full and at half size.`;

export const bench: Bench = {
  name: 'pictures',
  summary: 'kernel: shrinking a camera’s picture and encoding it as JPEG',
  usage: USAGE,
  async run(argv) {
    const { width, height, quality, rounds, json } = benchOptions(argv, {
      width: option.number(640, { least: 16 }),
      height: option.number(480, { least: 16 }),
      quality: option.number(70, { least: 1 }),
      rounds: option.number(200, { least: 1 }),
    });

    const simulation = await Simulation.create({ seed: 1, camera: { width, height } });
    const { colour } = simulation.renderFrame({ points: false });
    const rgba = new Uint8Array(colour.buffer, colour.byteOffset, width * height * 4).slice();
    simulation.close();
    const bgr = new Uint8Array(width * height * 3);
    for (let i = 0, at = 0; i < rgba.length; i += 4, at += 3) {
      bgr.set([rgba[i + 2] as number, rgba[i + 1] as number, rgba[i] as number], at);
    }
    const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: '' };
    const size = { width, height, step: width * 3, encoding: 'bgr8', is_bigendian: false };
    const image = { header, ...size, data: bgr };

    const codec = await PictureCodec.load();
    const filter = new ShrinkingFilter();
    const made = (factor: number) => codec.encodeJpeg(filter.shrink(pictureRows(image), factor), quality);
    const jpeg = codec.encodeJpeg({ width, height, rgba }, quality);
    const time = (call: () => unknown) => rounded(distribution(timeCalls(call, rounds)));
    const encode = time(() => codec.encodeJpeg({ width, height, rgba }, quality));
    const decode = time(() => codec.decode('jpeg', jpeg, width * height));
    const whole = time(() => made(1));
    const halved = time(() => made(2));

    console.log(`a picture of ${width} × ${height} pixels, quality ${quality} (kernel: one process)`);
    printTable(
      ['ms', 'p50', 'p95', 'p99', 'max', 'bytes'],
      [
        ['JPEG written', ...distributionCells(encode), jpeg.length],
        ['JPEG read', ...distributionCells(decode), jpeg.length],
        ['bgr8 to JPEG', ...distributionCells(whole), made(1).length],
        ['bgr8, halved, to JPEG', ...distributionCells(halved), made(2).length],
      ],
    );
    if (json) {
      const bytes = { bytes: jpeg.length, halvedBytes: made(2).length };
      const times = { encodeMs: encode, decodeMs: decode, wholeMs: whole, halvedMs: halved };
      printJson({ bench: 'pictures', width, height, quality, ...bytes, ...times });
    }
  },
};
