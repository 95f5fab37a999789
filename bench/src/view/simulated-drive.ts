/**
 * The standard drive of `pnpm bench view`: a robot among furniture and walking people, its packets as a link of a given
 * rate and loss delivers them, and what eyes would truly see.
 */
import { Random } from '@farpoint/network-sim';
import {
  bytesOfPoints,
  type CloudFormat,
  emptyPlacement,
  PLACEMENT_BYTES,
  type PointPacketHeader,
  type Pose,
  writePlacement,
  writePointPacketHeader,
} from '@farpoint/protocol';
import {
  type CameraOptions,
  type CloudFrame,
  officeWorld,
  SimulatedBase,
  SimulatedCamera,
} from '@farpoint/sim';
import { BitRate } from '@farpoint/timing';
import {
  BYTES_PER_POINT,
  type Codec,
  OrganisedEncoder,
  type OrganisedReport,
  POINTS_PER_PACKET,
  Points64Encoder,
} from '@farpoint/wasm-codec';
import type { Picture } from './picture-difference.ts';

export interface DriveOptions {
  rateMbps: number;
  /** Share of packets lost, 0–1. */
  loss: number;
  framesPerSecond: number;
  seed: number;
  /** Side of the true pictures, pixels. */
  size: number;
  /** Quality of organised packets' colours, 0 to 31 (coarsest): the rest of the rate is the depth's. Default: as robots code. */
  colourQuality?: number | undefined;
}

/** Where an eye looks from, on the robot. */
export interface Eye {
  name: string;
  /** Vertical field of view, degrees. */
  fieldOfView: number;
  mount: Pick<CameraOptions, 'forward' | 'up' | 'pitch'>;
}

/** In the depth camera's place, and above and behind the robot. */
export const EYES: readonly Eye[] = [
  { name: 'eye', fieldOfView: 75, mount: {} },
  { name: 'shoulder', fieldOfView: 75, mount: { forward: -1.4, up: 1.7, pitch: 0.35 } },
];

export interface DriveFrame {
  /** RTP payloads that arrived. */
  organised: ArrayBuffer[];
  points64: ArrayBuffer[];
  /** The depth camera's own picture: R, G, B, 255 of each pixel. */
  picture: { rgba: Uint8Array; width: number; height: number; captureTimeUs: number };
  /** Whether every point was sent in `organised`. */
  whole: boolean;
  /** Depth errors of `organised` are at most 0.0625 · 2^level mm · z². */
  depthLevel: number;
}

/** Of the organised codec. */
const COARSEST_DEPTH = 7;
const HEADER_BYTES = 16;
/** By how much a coded frame may exceed its budget. */
const BUDGET_SLACK = 1.06;
/** For whose headers room is left in a frame's budget. */
const PACKETS = 60;
/** The robot drives in a circle, m/s and rad/s, and sees everything around it. */
const SPEED = 0.4;
const TURN = 0.5;

export class SimulatedDrive {
  readonly streamHeader: Uint8Array;
  readonly #options: DriveOptions;
  readonly #base: SimulatedBase;
  readonly #camera: SimulatedCamera;
  readonly #eyes: readonly SimulatedCamera[];
  readonly #organised: OrganisedEncoder;
  readonly #points64: Points64Encoder;
  readonly #random: Random;
  #frame = 0;
  #captureTimeUs = 0;
  #whole = true;
  #depthLevel = 0;

  private constructor(
    codec: Codec,
    options: DriveOptions,
    base: SimulatedBase,
    camera: SimulatedCamera,
    eyes: readonly SimulatedCamera[],
  ) {
    this.#options = options;
    this.#base = base;
    this.#camera = camera;
    this.#eyes = eyes;
    const { width, height } = camera.intrinsics;
    this.#organised = new OrganisedEncoder(codec, { width, height });
    this.#points64 = new Points64Encoder(codec, width * height);
    this.streamHeader = this.#organised.begin(camera.intrinsics, { fromImages: true }).slice();
    this.#random = new Random(options.seed, 0);
  }

  static async create(codec: Codec, options: DriveOptions): Promise<SimulatedDrive> {
    const world = officeWorld();
    const { seed, size } = options;
    const camera = await SimulatedCamera.create({ world, seed });
    const eyes = await Promise.all(
      EYES.map(({ fieldOfView, mount }) =>
        SimulatedCamera.create({
          world,
          seed,
          camera: {
            ...mount,
            width: size,
            height: size,
            fieldOfView: (fieldOfView * Math.PI) / 180,
            near: 0.05,
            far: 60,
          },
        }),
      ),
    );
    return new SimulatedDrive(codec, options, new SimulatedBase(world), camera, eyes);
  }

  /** Drives on to the next frame, and returns what of it arrives. */
  next(): DriveFrame {
    const { framesPerSecond, rateMbps } = this.#options;
    this.#base.setCommand({ linear: { x: SPEED, y: 0, z: 0 }, angular: { x: 0, y: 0, z: TURN } });
    this.#base.step(1 / framesPerSecond);
    const frame = this.#camera.render(this.#base.snapshot);
    const budgetBytes = Math.floor(BitRate.bytesIn(BitRate.fromMbps(rateMbps), 1000 / framesPerSecond));
    this.#captureTimeUs = Math.round(this.#base.snapshot.time * 1e6);
    const number = this.#frame++;
    const { width, height } = frame;
    const rgba = frame.colour.slice();
    return {
      organised: this.#arrived(this.#organisedPayloads(frame, number, budgetBytes)),
      points64: this.#arrived(this.#points64Payloads(frame, number, budgetBytes)),
      picture: { rgba, width, height, captureTimeUs: this.#captureTimeUs },
      whole: this.#whole,
      depthLevel: this.#depthLevel,
    };
  }

  /** What each of {@link EYES} truly sees now, and from where. */
  truth(): { pose: Pose; picture: Picture }[] {
    return this.#eyes.map((eye) => {
      const { cameraPose, colour, depth } = eye.render(this.#base.snapshot, {
        groundTruth: true,
        points: false,
      });
      return { pose: cameraPose, picture: { colour: colour.slice(), depth: depth.slice() } };
    });
  }

  close(): void {
    for (const camera of [this.#camera, ...this.#eyes]) camera.close();
    this.#organised[Symbol.dispose]();
    this.#points64[Symbol.dispose]();
  }

  #organisedPayloads(frame: CloudFrame, frameNumber: number, budgetBytes: number): ArrayBuffer[] {
    const encoder = this.#organised;
    encoder.depth.set(frame.depth);
    encoder.colour.set(new Uint32Array(frame.colour.buffer, frame.colour.byteOffset, frame.depth.length));
    const trailers = (PLACEMENT_BYTES + HEADER_BYTES) * PACKETS;
    const budget = budgetBytes - trailers;
    const { colourQuality: quality } = this.#options;
    const { packets, points, reasons, bytes, depthLevel } =
      quality === undefined
        ? encoder.encode({ fromImages: true, budgetBytes: budget })
        : this.#finestDepth(budget, quality);
    this.#whole = reasons.thinned + reasons.dropped === 0 && bytes <= budget * BUDGET_SLACK;
    this.#depthLevel = depthLevel;
    let sequenceOffset = 0;
    return Array.from({ length: packets }, (_, i) => {
      const sequenceLength = bytesOfPoints(encoder.lengths[i * 2 + 1] as number);
      const header = { frameNumber, frameLength: bytesOfPoints(points), sequenceOffset, sequenceLength };
      sequenceOffset += sequenceLength;
      return this.#payload(header, encoder.packet(i), 'organised', frame.cameraPose);
    });
  }

  /** That fits beside colours of this quality. */
  #finestDepth(budget: number, quality: number): OrganisedReport {
    const encode = (depthLevel: number) =>
      this.#organised.encode({ fromImages: true, depthLevel, colour: { quality } });
    let level = 0;
    let report = encode(level);
    while (report.bytes > budget && level < COARSEST_DEPTH) report = encode(++level);
    return report;
  }

  #points64Payloads(frame: CloudFrame, frameNumber: number, budgetBytes: number): ArrayBuffer[] {
    const encoder = this.#points64;
    const points = frame.depth.length;
    encoder.frame.set(frame.points);
    const packet = POINTS_PER_PACKET * BYTES_PER_POINT + HEADER_BYTES + PLACEMENT_BYTES;
    const count = Math.min(Math.floor(budgetBytes / packet) * POINTS_PER_PACKET, points);
    const { kept } = encoder.sample({ points, count, seed: this.#options.seed + frameNumber });
    const { packets } = encoder.pack();
    const { stride, dataOffset } = encoder.layout;
    return Array.from({ length: packets }, (_, i) => {
      const first = i * POINTS_PER_PACKET;
      const sequenceLength = bytesOfPoints(Math.min(POINTS_PER_PACKET, kept - first));
      const at = i * stride + dataOffset;
      const data = encoder.packets.subarray(at, at + sequenceLength);
      const place = { frameNumber, frameLength: bytesOfPoints(kept), sequenceOffset: bytesOfPoints(first) };
      return this.#payload({ ...place, sequenceLength }, data, 'points64', frame.cameraPose);
    });
  }

  #arrived(payloads: ArrayBuffer[]): ArrayBuffer[] {
    return payloads.filter(() => this.#random.next() >= this.#options.loss);
  }

  /** An RTP payload of our own profile. */
  #payload(header: PointPacketHeader, data: Uint8Array, format: CloudFormat, pose: Pose): ArrayBuffer {
    const payload = new Uint8Array(HEADER_BYTES + data.length + PLACEMENT_BYTES);
    const view = new DataView(payload.buffer);
    writePointPacketHeader(view, 0, header);
    payload.set(data, HEADER_BYTES);
    const placement = { ...emptyPlacement(), pose, format, captureTimeUs: this.#captureTimeUs };
    writePlacement(view, HEADER_BYTES + data.length, placement);
    return payload.buffer;
  }
}
