/** `pnpm bench pack`: a kernel benchmark of the points64 layout. */
import { parseArgs } from 'node:util';
import { CloudDecoder, POINTS_PER_PACKET, Points64Encoder, packetsFor } from '@farpoint/wasm-codec';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { packPlainly, unpackPlainly } from './pack-plain.ts';
import { type Bench, distributionCells, numberOption, printJson, printTable } from './report.ts';
import { hallCloud } from './sampling-scene.ts';
import { distribution, rounded, timeCalls } from './stats.ts';

const USAGE = `pnpm bench pack [--points 30000] [--raw 230400] [--rounds 500] [--json]

Kernel benchmark, in one process. Packs --points points, sampled from a cloud of --raw, into packet slots and unpacks them
again, in WASM and in plain JavaScript.`;

export const bench: Bench = {
  name: 'pack',
  summary: 'kernel: time to pack and unpack points64 packets, compared with plain JavaScript',
  async run(argv) {
    const { values } = parseArgs({
      args: argv,
      options: {
        points: { type: 'string', default: '30000' },
        raw: { type: 'string', default: '230400' },
        rounds: { type: 'string', default: '500' },
        json: { type: 'boolean' },
        help: { type: 'boolean' },
      },
    });
    if (values.help) return console.log(USAGE);
    const count = numberOption('points', values.points, 1);
    const raw = Math.max(numberOption('raw', values.raw, 1), Math.ceil(count * 1.2));
    const rounds = numberOption('rounds', values.rounds, 1);

    const codec = await loadCodecFromDisk();
    const packets = packetsFor(count);
    using encoder = new Points64Encoder(codec, raw);
    using decoder = new CloudDecoder(codec, packets);
    encoder.frameBits.set(new Uint32Array(hallCloud(raw).frame.buffer));
    const { kept } = encoder.sample({ points: raw, count, seed: 1 });
    const chosen = encoder.chosen.slice();
    const { layout } = encoder;

    const pack = rounded(distribution(timeCalls(() => encoder.pack(), rounds)), 4);
    decoder.slots.set(encoder.packets.subarray(0, packets * layout.stride));
    for (let i = 0; i < packets; i++)
      decoder.counts[i] = Math.min(POINTS_PER_PACKET, kept - i * POINTS_PER_PACKET);
    const unpack = rounded(distribution(timeCalls(() => decoder.unpack(packets), rounds)), 4);

    const slots = new Uint8Array(packets * layout.stride);
    const view = new DataView(slots.buffer);
    const { frame, frameBits, counts } = {
      frame: encoder.frame,
      frameBits: encoder.frameBits,
      counts: decoder.counts,
    };
    const plainPack = rounded(
      distribution(timeCalls(() => packPlainly(frame, frameBits, chosen, layout, view), rounds)),
      4,
    );
    const points = new Int16Array(kept * 4);
    const plainUnpack = rounded(
      distribution(timeCalls(() => unpackPlainly(view, counts, packets, layout, points), rounds)),
      4,
    );
    const agree = Buffer.compare(bytesOf(decoder.unpack(packets)), bytesOf(points)) === 0;
    if (!agree) throw new Error('WASM and plain JavaScript give different points');

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
    if (values.json) {
      printJson({
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
      });
    }
  },
};

function bytesOf(points: Int16Array): Uint8Array {
  return new Uint8Array(points.buffer, points.byteOffset, points.byteLength);
}
