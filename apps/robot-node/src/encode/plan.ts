/**
 * From a bit rate, counted on the wire, to frames a second and points a frame. Two policies:
 *
 * - `paper`: every frame of the source, as many points as the paper's equations 2 and 3 say.
 * - `latency`: as many frames a second as can still be read as pictures. What an operator waits for is the next capture
 *   and the sending of one frame; both last as long as a frame interval, so smaller frames halve them. The floor is one
 *   packet a frame: on a link that carries nothing, commands and telemetry matter more than the paper's floor of points.
 */

import {
  type CloudFormat,
  MAX_POINT_DATA_BYTES,
  PLACEMENT_BYTES,
  POINT_PACKET_HEADER_BYTES,
  POINTS_PER_PACKET,
} from '@farpoint/protocol';
import { BitRate } from '@farpoint/timing';
import { maxPoints } from '@farpoint/wasm-codec';

export const PLAN_POLICIES = ['latency', 'paper'] as const;
export type PlanPolicy = (typeof PLAN_POLICIES)[number];

export interface PlanOptions {
  policy: PlanPolicy;
  /** What the source can give, frames a second. */
  mostFramesPerSecond: number;
  /** It gives a frame whenever it is asked: what this computer can do need not be a whole fraction of that. */
  anyRate: boolean;
  /** Equation 3's fraction of the raw cloud a second that is sent whatever the rate; for the policy `paper`. */
  floorFraction: number;
  /** The configuration's own limit of points a frame. */
  mostPoints: number;
}

export interface PlanInput {
  /** What the stream may take on the wire, all headers counted, bit/s. */
  targetBitsPerSecond: number;
  /** Points of the raw cloud. */
  rawPoints: number;
  /** Bytes that the transport adds to each payload: RTP, SRTP, UDP, IP. */
  overheadBytes: number;
  /** The rate control wants to try the link with a train of so many bytes on the wire; 0 for none. */
  probeBytes: number;
  /** How long the capture thread works on a frame, by the clock: whatever else keeps the processors busy counts, ms. */
  workMs: number;
}

export type CodedFormat = Exclude<CloudFormat, 'points64'>;

/** Best first. */
export const CODED_FORMATS: readonly CodedFormat[] = ['organised', 'unorganised'];

export interface FramePlan {
  framesPerSecond: number;
  /** Whole packets' worth. */
  points: number;
}

/** The same for a coded format, whose bits a point depend on the frame. */
export interface CodedPlan {
  framesPerSecond: number;
  /** For the data of all packets. */
  budgetBytes: number;
}

/** Fewer points do not make a picture of a room: rather fewer frames. */
const LEAST_POINTS = 3000;
const LEAST_BYTES = LEAST_POINTS;
/** … but the world must still move, frames a second. */
const LEAST_FRAMES_PER_SECOND = 10;
/** A higher frame rate is chosen only where it can be kept when the link gives a little less. */
const UPWARD_MARGIN = 1.25;
/** The capture thread also reads commands, moves the robot and must not fall behind: share of its time for frames. */
const MOST_LOAD = 0.7;
/** Of a source that need not give so many: on a computer that is full, each further frame makes all of them later. */
const MOST_LOAD_AT_ANY_RATE = 0.5;
/** What a coded frame needs, bits for each point of the raw cloud. */
interface CodedNeed {
  /** The frame is whole, if coarse: below, rather fewer frames. */
  whole: number;
  /** As fine as a depth camera itself is, by far: what the link has more makes the stream quicker, not finer. */
  enough: number;
}
const CODED_NEEDS: Readonly<Record<CodedFormat, CodedNeed>> = {
  // Cameras' frames within 0.5 mm · z² and with colours of 34 dB take 1.9 to 2.3 bits.
  organised: { whole: 1.6, enough: 2.4 },
  // Its step is fixed, so that only the number of points can change.
  unorganised: { whole: 16, enough: 64 },
};
/** A coded frame may come out so much smaller than its budget; one that is to carry a train must not. */
const CODED_SLACK = 1.06;
/** A probe may make a frame so much larger than planned, at most. */
const MOST_PROBE_FACTOR = 8;

export class FramePlanner {
  readonly #options: PlanOptions;
  #framesPerSecond: number;

  constructor(options: PlanOptions) {
    this.#options = options;
    this.#framesPerSecond = options.mostFramesPerSecond;
  }

  /** The plan for the frame that is captured now. */
  plan(input: PlanInput): FramePlan {
    const { policy, mostFramesPerSecond, floorFraction, mostPoints } = this.#options;
    const { rawPoints } = input;
    const wireBytes = wireBytesOfPacket(input.overheadBytes);
    // Of each packet's bytes on the wire only the points count for the equation.
    const pointBitsPerSecond = (input.targetBitsPerSecond * MAX_POINT_DATA_BYTES) / wireBytes;
    const most = Math.floor(mostPoints / POINTS_PER_PACKET) * POINTS_PER_PACKET;
    if (policy === 'paper') {
      const framesPerSecond = mostFramesPerSecond;
      const planned = maxPoints({
        bitsPerSecond: pointBitsPerSecond,
        framesPerSecond,
        points: rawPoints,
        floorFraction,
      });
      return { framesPerSecond, points: Math.min(planned, most) };
    }
    const framesPerSecond = this.#chooseFrameRate(pointBitsPerSecond / 64, Math.min(most, rawPoints), input);
    return { framesPerSecond, points: this.pointsAt(framesPerSecond, input) };
  }

  /** Points of a frame at this frame rate: what the rate allows, or the train that the rate control waits for. */
  pointsAt(framesPerSecond: number, input: PlanInput): number {
    const wireBytes = wireBytesOfPacket(input.overheadBytes);
    const most = Math.floor(this.#options.mostPoints / POINTS_PER_PACKET) * POINTS_PER_PACKET;
    const points = maxPoints({
      bitsPerSecond: (input.targetBitsPerSecond * MAX_POINT_DATA_BYTES) / wireBytes,
      framesPerSecond,
      points: input.rawPoints,
      floorFraction: 0,
    });
    const probePackets = Math.min(
      Math.ceil(input.probeBytes / wireBytes),
      (MOST_PROBE_FACTOR * Math.max(points, LEAST_POINTS)) / POINTS_PER_PACKET,
    );
    const wanted = Math.max(points, Math.floor(probePackets) * POINTS_PER_PACKET, POINTS_PER_PACKET);
    return Math.min(wanted, most);
  }

  /**
   * The plan for a frame in a coded format: as many frames a second as are whole, each as fine as the rate allows.
   */
  planCoded(format: CodedFormat, input: PlanInput): CodedPlan {
    const { rawPoints } = input;
    const need = CODED_NEEDS[format];
    const wireBytes = wireBytesOfPacket(input.overheadBytes);
    const dataShare = MAX_POINT_DATA_BYTES / wireBytes;
    const bitsPerSecond = input.targetBitsPerSecond * dataShare;
    const framesPerSecond = this.#chooseFrameRate(bitsPerSecond / need.whole, rawPoints, input, rawPoints);
    const enough = (rawPoints * need.enough) / 8;
    const afforded = Math.min(BitRate.toBytesPerSecond(bitsPerSecond) / framesPerSecond, enough);
    const probed = Math.min(
      input.probeBytes * dataShare * CODED_SLACK,
      MOST_PROBE_FACTOR * Math.max(afforded, LEAST_BYTES),
    );
    return {
      framesPerSecond,
      budgetBytes: Math.floor(Math.max(afforded, probed, MAX_POINT_DATA_BYTES)),
    };
  }

  /** The most that frames like this one can use, all headers counted, bit/s. */
  usefulBitsPerSecond(format: CloudFormat, { rawPoints, overheadBytes }: PlanInput): number {
    const { mostFramesPerSecond, mostPoints } = this.#options;
    const plain = format === 'points64';
    const bits = plain ? Math.min(rawPoints, mostPoints) * 64 : rawPoints * CODED_NEEDS[format].enough;
    return (bits * mostFramesPerSecond * wireBytesOfPacket(overheadBytes)) / MAX_POINT_DATA_BYTES;
  }

  /**
   * The source's rate, or a whole fraction of it: cameras can be asked for every second picture, not for every 1.3rd. Of a
   * source that gives a frame whenever it is asked, as many more as there is time for.
   */
  #chooseFrameRate(
    pointsPerSecond: number,
    mostPoints: number,
    { workMs }: PlanInput,
    wanted = LEAST_POINTS,
  ): number {
    const { mostFramesPerSecond, anyRate } = this.#options;
    const floor = Math.min(LEAST_FRAMES_PER_SECOND, mostFramesPerSecond);
    const least = Math.min(wanted, mostPoints);
    const load = anyRate ? MOST_LOAD_AT_ANY_RATE : MOST_LOAD;
    const affordable = workMs > 0 ? (1000 * load) / workMs : Number.POSITIVE_INFINITY;
    for (let divisor = 1; ; divisor++) {
      const candidate = mostFramesPerSecond / divisor;
      const next = mostFramesPerSecond / (divisor + 1);
      const margin = candidate > this.#framesPerSecond ? UPWARD_MARGIN : 1;
      const inTime = anyRate || candidate * (margin === 1 ? 1 : 1.1) <= affordable;
      const fits = pointsPerSecond / candidate >= least * margin && inTime;
      if (!fits && next >= floor) continue;
      this.#framesPerSecond = candidate;
      return anyRate ? Math.max(Math.min(candidate, affordable), floor) : candidate;
    }
  }
}

/** A full packet with all its headers. */
export function wireBytesOfPacket(overheadBytes: number): number {
  return POINT_PACKET_HEADER_BYTES + MAX_POINT_DATA_BYTES + PLACEMENT_BYTES + overheadBytes;
}
