/** `pnpm bench pack`: a kernel benchmark of the points64 layout. */
import {
  CloudDecoder,
  type Codec,
  POINTS_PER_PACKET,
  Points64Encoder,
  packetsFor,
} from '@farpoint/wasm-codec';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { benchOptions, option } from './bench-options.ts';
import { packPlainly, unpackPlainly } from './pack-plain.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { hallCloud } from './sampling-scene.ts';
import { type Distribution, distribution, rounded, timeCalls } from './stats.ts';

const USAGE = `pnpm bench pack [--points 30000] [--raw 230400] [--rounds 500] [--json]

Kernel benchmark, in one process. Packs --points points, sampled from a cloud of --raw, into packet slots and unpacks them
again, in WASM and in plain JavaScript.`;

export const bench: Bench = {
  name: 'pack',
  summary: 'kernel: time to pack and unpack points64 packets, compared with plain JavaScript',
  usage: USAGE,
  async run(argv) {
    const { points, rounds, json, ...options } = benchOptions(argv, {
      points: option.number(30_000, { least: 1 }),
      raw: option.number(230_400, { least: 1 }),
      rounds: option.number(500, { least: 1 }),
    });
    const raw = Math.max(options.raw, Math.ceil(points * 1.2));
    const times = measure(await loadCodecFromDisk(), { count: points, raw, rounds });
    print(times);
    if (json) printJson(figuresOf(times));
  },
};

interface Load {
  /** Points to pack. */
  count: number;
  /** Points of the cloud from which they are sampled. */
  raw: number;
  rounds: number;
}

interface Times {
  /** Points, and packets that they take. */
  kept: number;
  packets: number;
  /** Times of a call, ms. */
  pack: Distribution;
  unpack: Distribution;
  plainPack: Distribution;
  plainUnpack: Distribution;
}

/** @throws {Error} if WASM and JavaScript do not agree */
function measure(codec: Codec, { count, raw, rounds }: Load): Times {
  const packets = packetsFor(count);
  using encoder = new Points64Encoder(codec, raw);
  using decoder = new CloudDecoder(codec, packets);
  encoder.frameBits.set(new Uint32Array(hallCloud(raw).frame.buffer));
  const { kept } = encoder.sample({ points: raw, count, seed: 1 });
  const chosen = encoder.chosen.slice();
  const { layout } = encoder;
  const time = (call: () => void) => rounded(distribution(timeCalls(call, rounds)), 4);

  const pack = time(() => encoder.pack());
  decoder.slots.set(encoder.packets.subarray(0, packets * layout.stride));
  for (let i = 0; i < packets; i++)
    decoder.counts[i] = Math.min(POINTS_PER_PACKET, kept - i * POINTS_PER_PACKET);
  const unpack = time(() => decoder.unpack(packets));

  const slots = new Uint8Array(packets * layout.stride);
  const view = new DataView(slots.buffer);
  const { frame, frameBits } = encoder;
  const { counts } = decoder;
  const plainPack = time(() => packPlainly(frame, frameBits, chosen, layout, view));
  const points = new Int16Array(kept * 4);
  const plainUnpack = time(() => unpackPlainly(view, counts, packets, layout, points));
  const agree = Buffer.compare(bytesOf(decoder.unpack(packets)), bytesOf(points)) === 0;
  if (!agree) throw new Error('WASM and plain JavaScript give different points');
  return { kept, packets, pack, unpack, plainPack, plainUnpack };
}

function print({ kept, packets, pack, unpack, plainPack, plainUnpack }: Times): void {
  console.log(`${kept} points in ${packets} packets (kernel: one process, no link)`);
  printTable(
    ['ms', 'p50', 'p95', 'p99', 'max'],
    [
      ['pack, WASM', ...distributionCells(pack)],
      ['pack, plain JavaScript', ...distributionCells(plainPack)],
      ['unpack, WASM', ...distributionCells(unpack)],
      ['unpack, plain JavaScript', ...distributionCells(plainUnpack)],
    ],
  );
}

/** @returns the object that `--json` prints */
function figuresOf({ kept, pack, unpack, plainPack, plainUnpack }: Times) {
  return {
    bench: 'pack',
    points: kept,
    packMsP50: pack.p50,
    unpackMsP50: unpack.p50,
    packMs: pack,
    unpackMs: unpack,
    plainPackMsP50: plainPack.p50,
    plainUnpackMsP50: plainUnpack.p50,
    packSpeedup: plainPack.p50 / pack.p50,
    unpackSpeedup: plainUnpack.p50 / unpack.p50,
  };
}

function bytesOf(points: Int16Array): Uint8Array {
  return new Uint8Array(points.buffer, points.byteOffset, points.byteLength);
}
