/** `pnpm bench temporal`: what it would gain, and cost, to leave out the tiles of a frame that have not changed. */
import { parseArgs } from 'node:util';
import { seededRandom } from '@farpoint/congestion/sim';
import { zeroTwist } from '@farpoint/protocol';
import { Simulation } from '@farpoint/sim';
import { type Codec, OrganisedDecoder, OrganisedEncoder } from '@farpoint/wasm-codec';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { type Bench, numberOption, printJson, printTable } from './report.ts';
import { changedTiles, TILE, type TileChange } from './temporal/tile-change.ts';

const USAGE = `pnpm bench temporal [--frames 90] [--refresh 15] [--loss 5] [--json]

Kernel benchmark of an idea that the organised codec has not: send only the tiles that have changed since they were sent
last, and each at least every --refresh frames; the receiver keeps what it has. The real encoder codes the frames of the
simulated camera (30 a second) whole, and with the unchanged tiles blanked. Of --loss % of the packets lost:
missing    share of the points that the receiver of whole frames does not have
wrong      share of the pixels of the receiver that keeps old tiles which show what is no longer so
A pixel has changed where its depth is off by more than noise explains, or a colour by more than 12 of 255.`;

const SCENES = [
  { name: 'standing', linear: 0, angular: 0 },
  { name: 'creeping, 0.05 m/s', linear: 0.05, angular: 0 },
  { name: 'turning, 0.3 rad/s', linear: 0, angular: 0.3 },
  { name: 'driving, 0.5 m/s, 0.3 rad/s', linear: 0.5, angular: 0.3 },
] as const;
const SETTINGS = { depthLevel: 3, colour: { quality: 18 }, fromImages: true } as const;
/** Until people and carts have come to where they walk, s. */
const LEAD_S = 4;

interface Row {
  scene: string;
  /** Bits for each point of the cloud. */
  wholeBits: number;
  changedBits: number;
  saved: number;
  tilesSent: number;
  missing: number;
  wrong: number;
}

export const bench: Bench = {
  name: 'temporal',
  summary: 'kernel: what leaving out unchanged tiles would gain, and what it would cost under loss',
  async run(argv) {
    const { values } = parseArgs({
      args: argv,
      options: {
        frames: { type: 'string', default: '90' },
        refresh: { type: 'string', default: '15' },
        loss: { type: 'string', default: '5' },
        json: { type: 'boolean' },
        help: { type: 'boolean' },
      },
    });
    if (values.help) return console.log(USAGE);
    const frames = numberOption('frames', values.frames, 2);
    const refresh = numberOption('refresh', values.refresh, 1);
    const loss = numberOption('loss', values.loss) / 100;
    const codec = await loadCodecFromDisk();
    const rows: Row[] = [];
    for (const scene of SCENES) rows.push(await measure(codec, scene, frames, refresh, loss));
    printTable(
      ['robot', 'whole, bits/pt', 'changed only', 'saved', 'tiles sent', 'missing', 'wrong'],
      rows.map((row) => [
        row.scene,
        row.wholeBits,
        row.changedBits,
        percent(row.saved),
        percent(row.tilesSent),
        percent(row.missing),
        percent(row.wrong),
      ]),
    );
    if (values.json) printJson({ bench: 'temporal', frames, refresh, lossRate: loss, rows });
  },
};

async function measure(
  codec: Codec,
  scene: (typeof SCENES)[number],
  frames: number,
  refresh: number,
  loss: number,
): Promise<Row> {
  const simulation = await Simulation.create({ seed: 1 });
  const { width, height } = simulation.intrinsics;
  using encoder = new OrganisedEncoder(codec, { width, height });
  const change: TileChange = { width, height, noisePerZ2: 0.0015 };
  const columns = Math.ceil(width / TILE);
  const tiles = columns * Math.ceil(height / TILE);
  const sent = { depth: new Float32Array(width * height), colour: new Uint32Array(width * height) };
  const shown = new Float32Array(width * height);
  const random = seededRandom(1);
  const command = zeroTwist();
  const sums = { points: 0, whole: 0, changed: 0, tiles: 0, missing: 0, wrong: 0 };
  simulation.step(LEAD_S);
  command.linear.x = scene.linear;
  command.angular.z = scene.angular;
  let header: Uint8Array | undefined;
  let decoder: OrganisedDecoder | undefined;
  for (let frame = 0; frame < frames; frame++) {
    simulation.setCommand(command);
    simulation.step(1 / 30);
    const images = simulation.renderFrame({ points: false });
    const depth = images.depth.slice();
    const colour = new Uint32Array(images.colour.slice().buffer);
    const put = () => {
      encoder.depth.set(depth);
      encoder.colour.set(colour);
    };
    put();
    header ??= encoder.begin(simulation.intrinsics, { fromImages: true }).slice();
    decoder ??= new OrganisedDecoder(codec, header, { images: true });
    const whole = encoder.encode(SETTINGS);
    const lostPoints = Array.from({ length: whole.packets }, (_, i) =>
      random() < loss ? (encoder.lengths[i * 2 + 1] as number) : 0,
    ).reduce((sum, points) => sum + points, 0);

    const changed = changedTiles(change, sent, { depth, colour });
    put();
    for (let tile = 0; tile < tiles; tile++) {
      const due = (frame + tile) % refresh === 0;
      if (frame === 0 || changed[tile] === 1 || due) {
        copyTile(sent, { depth, colour }, tile, columns, width, height);
        sums.tiles++;
      } else blankTile(encoder.depth, tile, columns, width, height);
    }
    const part = encoder.encode(SETTINGS);
    decoder.begin();
    for (let packet = 0; packet < part.packets; packet++) {
      // The first frame comes whole: what is asked is how errors grow from there.
      if (frame === 0 || random() >= loss) decoder.put(encoder.packet(packet));
    }
    // A tile with any pixel has come; where a tile has become empty nothing tells it, and it stays.
    const { depth: came } = decoder;
    for (let pixel = 0; pixel < shown.length; pixel++) {
      if ((came[pixel] as number) > 0) shown[pixel] = came[pixel] as number;
    }
    if (frame === 0) continue;
    sums.points += whole.points;
    sums.whole += whole.bytes;
    sums.changed += part.bytes;
    sums.missing += lostPoints;
    sums.wrong += pixelsOff(depth, shown);
  }
  decoder?.[Symbol.dispose]();
  simulation.close();
  const bits = (bytes: number) => Number(((bytes * 8) / sums.points).toFixed(3));
  return {
    scene: scene.name,
    wholeBits: bits(sums.whole),
    changedBits: bits(sums.changed),
    saved: Number((1 - sums.changed / sums.whole).toFixed(4)),
    tilesSent: Number((sums.tiles / (tiles * frames)).toFixed(4)),
    missing: Number((sums.missing / sums.points).toFixed(4)),
    wrong: Number((sums.wrong / sums.points).toFixed(4)),
  };
}

/** Pixels that are shown at a depth which neither noise nor the coder's error explains. */
function pixelsOff(depth: Float32Array, shown: Float32Array): number {
  let wrong = 0;
  for (let i = 0; i < depth.length; i++) {
    const [z, s] = [depth[i] as number, shown[i] as number];
    if (z > 0 && s > 0 && Math.abs(z - s) > (0.0005 + 6 * 0.0015) * Math.max(z, s) ** 2) wrong++;
  }
  return wrong;
}

interface Images {
  depth: Float32Array;
  colour: Uint32Array;
}

function copyTile(
  into: Images,
  from: Images,
  tile: number,
  columns: number,
  width: number,
  height: number,
): void {
  forRows(tile, columns, width, height, (start, end) => {
    into.depth.set(from.depth.subarray(start, end), start);
    into.colour.set(from.colour.subarray(start, end), start);
  });
}

function blankTile(depth: Float32Array, tile: number, columns: number, width: number, height: number): void {
  forRows(tile, columns, width, height, (start, end) => depth.fill(0, start, end));
}

function forRows(
  tile: number,
  columns: number,
  width: number,
  height: number,
  visit: (start: number, end: number) => void,
): void {
  const [x, y] = [(tile % columns) * TILE, Math.floor(tile / columns) * TILE];
  for (let row = y; row < Math.min(y + TILE, height); row++)
    visit(row * width + x, row * width + Math.min(x + TILE, width));
}

function percent(share: number): string {
  return `${(share * 100).toFixed(1)} %`;
}
