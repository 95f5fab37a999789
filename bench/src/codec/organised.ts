import { bitsOfBytes } from '@farpoint/timing';
import {
  type Codec,
  CodecError,
  OrganisedDecoder,
  OrganisedEncoder,
  type OrganisedOptions,
  type Pinhole,
} from '@farpoint/wasm-codec';
import type { BenchCloud, CodecRun, DecodedCloud } from './adapter.ts';
import { nativeOrganised } from './native.ts';
import { verify } from './verify.ts';

/** A point of the rate–distortion curve. */
export interface OrganisedSetting {
  name: string;
  options: OrganisedOptions;
  /** Instead of a fixed colour coding: the one with the fewest bits that has at least this quality, dB. */
  psnrDb?: number;
}

/** Depth errors of 0.0625 · 2^level mm · z², colours by transform. */
export const ORGANISED_SETTINGS: readonly OrganisedSetting[] = [
  { name: '0.5 mm·z², default', options: {} },
  { name: '0.5 mm·z², 33 dB', options: { depthLevel: 3 }, psnrDb: 33 },
  { name: '0.5 mm·z², 40 dB', options: { depthLevel: 3 }, psnrDb: 40 },
  {
    name: '0.25 mm·z², quality 6, full chroma',
    options: { depthLevel: 2, colour: { quality: 6, chroma: 'full' } },
  },
  { name: '2 mm·z², quality 24', options: { depthLevel: 5, colour: { quality: 24 } } },
  { name: '0.5 mm·z², palette', options: { depthLevel: 3, colour: 'palette' } },
  { name: '0.5 mm·z², no colour', options: { depthLevel: 3, colour: 'none' } },
  { name: 'budget of 50,000 bytes', options: { budgetBytes: 50_000 } },
  { name: 'budget of 125,000 bytes', options: { budgetBytes: 125_000 } },
];

/** @returns the run, or why the cloud does not suit this codec or this setting */
export function organised(codec: Codec, cloud: BenchCloud, setting: OrganisedSetting): CodecRun | string {
  return setting.psnrDb === undefined
    ? organisedAs(codec, cloud, setting)
    : cheapest(codec, cloud, setting, setting.psnrDb);
}

/** Of half chroma, full chroma and palette, the one with the fewest bytes that is good enough. */
function cheapest(
  codec: Codec,
  cloud: BenchCloud,
  { name, options }: OrganisedSetting,
  psnrDb: number,
): CodecRun | string {
  let best: { run: CodecRun; bytes: number } | undefined;
  let reason = `no colours of ${psnrDb} dB`;
  const offer = (colour: NonNullable<OrganisedOptions['colour']>, words: string): boolean => {
    const run = organisedAs(codec, cloud, { name: `${name} (${words})`, options: { ...options, colour } });
    if (typeof run === 'string') {
      if (colour !== 'palette') reason = run;
      return false;
    }
    run.encode();
    run.decode(run.packetBytes().map((_, i) => i));
    const good = (verify(cloud, run.decoded()).colorPsnrDb ?? 0) >= psnrDb;
    const bytes = run.packetBytes().reduce((sum, size) => sum + size, 0);
    if (!good || bytes >= (best?.bytes ?? Number.POSITIVE_INFINITY)) {
      run[Symbol.dispose]();
      return good;
    }
    best?.run[Symbol.dispose]();
    best = { run, bytes };
    return true;
  };
  for (const chroma of ['half', 'full'] as const) {
    // Colours improve with the quality value. Bisect for the coarsest that is good enough.
    let [good, bad] = [-1, 32];
    while (bad - good > 1) {
      const quality = (good + bad) >> 1;
      if (offer({ quality, chroma }, `quality ${quality}, ${chroma} chroma`)) good = quality;
      else bad = quality;
    }
  }
  offer('palette', 'palette');
  return best?.run ?? reason;
}

function organisedAs(
  codec: Codec,
  cloud: BenchCloud,
  setting: Pick<OrganisedSetting, 'name' | 'options'>,
): CodecRun | string {
  const { width, height, frame } = cloud;
  if (height === 1 || cloud.depth === 'range') return 'the cloud has no grid';
  const encoder = new OrganisedEncoder(codec, { width, height });
  encoder.frameBits.set(new Uint32Array(frame.buffer, frame.byteOffset, frame.length));
  const fit = cloud.intrinsics === null ? encoder.estimateCamera() : encoder.checkCamera(cloud.intrinsics);
  if (!fit.fits) {
    encoder[Symbol.dispose]();
    return `the grid is not a camera's (${fit.reason}${fit.pixels === undefined ? '' : `, ${fit.pixels.toFixed(2)} pixels`})`;
  }
  const { camera } = fit;
  let header: Uint8Array;
  try {
    header = encoder.begin(camera, { palette: setting.options.colour === 'palette' });
  } catch (error) {
    encoder[Symbol.dispose]();
    if (error instanceof CodecError && error.code === 'too-many-colours')
      return 'too many colours for a palette';
    throw error;
  }
  const decoder = new OrganisedDecoder(codec, header);
  const witness = new OrganisedDecoder(codec, header, { images: true });
  return new OrganisedRun(cloud, setting, { camera, encoder, decoder, witness });
}

interface OrganisedParts {
  camera: Pinhole;
  encoder: OrganisedEncoder;
  /** The decoder that is timed. */
  decoder: OrganisedDecoder;
  /** A decoder that also says which pixel each point belongs to. */
  witness: OrganisedDecoder;
}

class OrganisedRun implements CodecRun {
  readonly codec = 'organised';
  readonly setting: string;
  readonly blob = false;
  readonly hasColour: boolean;
  readonly passes?: () => number;
  readonly independenceCost?: () => number;
  readonly #cloud: BenchCloud;
  readonly #options: OrganisedOptions;
  readonly #parts: OrganisedParts;
  #packets = 0;
  #passes = 0;
  #wanted: readonly number[] = [];

  constructor(
    cloud: BenchCloud,
    { name, options }: Pick<OrganisedSetting, 'name' | 'options'>,
    parts: OrganisedParts,
  ) {
    this.setting = name;
    this.hasColour = options.colour !== 'none';
    this.#cloud = cloud;
    this.#options = options;
    this.#parts = parts;
    if (options.budgetBytes !== undefined) this.passes = () => this.#passes;
    else
      this.independenceCost = () => {
        const bytes = this.packetBytes().reduce((sum, size) => sum + size, 0);
        return bitsOfBytes(bytes) / parts.encoder.bitsInOnePacket() - 1;
      };
  }

  encode(): void {
    ({ packets: this.#packets, passes: this.#passes } = this.#parts.encoder.encode(this.#options));
  }

  /** Encoders meet a budget with what they learned from earlier frames, as in a stream. */
  settle(): void {
    if (this.#options.budgetBytes !== undefined) for (let frame = 0; frame < 8; frame++) this.encode();
  }

  native(rounds: number) {
    return nativeOrganised(this.#cloud, this.#parts.camera, this.#options, rounds);
  }

  packetBytes(): number[] {
    return Array.from({ length: this.#packets }, (_, i) => this.#parts.encoder.packet(i).length);
  }

  decode(indices: readonly number[]): void {
    this.#wanted = indices;
    this.#put(this.#parts.decoder, indices);
  }

  decoded(): DecodedCloud {
    const { witness, camera } = this.#parts;
    this.#put(witness, this.#wanted);
    const { width } = this.#cloud;
    const { depth, colour } = witness;
    const source = Uint32Array.from(depth.keys()).filter((pixel) => (depth[pixel] as number) > 0);
    const metres = new Float64Array(source.length * 3);
    const rgb = new Uint8Array(source.length * 3);
    source.forEach((pixel, i) => {
      const z = depth[pixel] as number;
      const [u, v] = [pixel % width, Math.floor(pixel / width)];
      metres.set([((u - camera.cx) / camera.fx) * z, ((v - camera.cy) / camera.fy) * z, z], i * 3);
      const word = colour[pixel] as number;
      rgb.set([word & 0xff, (word >> 8) & 0xff, (word >> 16) & 0xff], i * 3);
    });
    return { points: source.length, metres, rgb, source };
  }

  [Symbol.dispose](): void {
    const { encoder, decoder, witness } = this.#parts;
    for (const object of [encoder, decoder, witness]) object[Symbol.dispose]();
  }

  /** Decodes packets in pairs, as the page does. */
  #put(into: OrganisedDecoder, indices: readonly number[]): void {
    into.begin();
    for (let i = 0; i < indices.length; i += 2) {
      const [first, second] = indices.slice(i, i + 2).map((index) => this.#parts.encoder.packet(index));
      if (first === undefined) break;
      const results = second === undefined ? [into.put(first)] : into.putTwo(first, second);
      for (const result of results) {
        if ('fault' in result) throw new Error(`packet ${indices[i]} or the next: ${result.fault}`);
      }
    }
  }
}
