/**
 * Turns a bit rate, counted on the wire, into frames per second and points per frame. Two policies:
 *
 * - `paper`: every frame of the source, with the number of points from the paper's equations 2 and 3.
 * - `latency`: as many frames per second as still make readable pictures. An operator waits for the next capture and
 *   then for one frame to be sent. Each lasts a frame interval, so halving the frames halves the wait. The floor is
 *   one packet per frame: on a link that carries nothing, commands and telemetry matter more than the paper's floor
 *   of points.
 */

import {
  BYTES_PER_POINT,
  type CloudFormat,
  MAX_POINT_DATA_BYTES,
  PLACEMENT_BYTES,
  POINT_PACKET_HEADER_BYTES,
  POINTS_PER_PACKET,
} from '@farpoint/protocol';
import { BitRate, bitsOfBytes, bytesOfBits } from '@farpoint/timing';
import { maxPoints } from '@farpoint/wasm-codec';

/** `auto`: our own coded formats for everyone who reads them; `points64`: only `points64`, for everyone. */
export const STREAM_MODES = ['auto', 'points64'] as const;
export type StreamMode = (typeof STREAM_MODES)[number];

export const PLAN_POLICIES = ['latency', 'paper'] as const;
export type PlanPolicy = (typeof PLAN_POLICIES)[number];

export interface PlanOptions {
  policy: PlanPolicy;
  /** The source's highest frame rate, frames/s, as declared. Fewer may come. */
  mostFramesPerSecond: number;
  /** The source gives a frame whenever it is asked, so the rate need not be a whole fraction of the highest. */
  anyRate: boolean;
  /** Equation 3's fraction of the raw cloud per second that is sent at any bit rate; for the policy `paper`. */
  floorFraction: number;
  /** The configured limit of points per frame. */
  mostPoints: number;
}

/** The most that an operator's computer can draw. */
export interface DrawnMost {
  /** Clouds a second. */
  framesPerSecond: number;
  /** Points of each. */
  points: number;
}

export interface PlanInput {
  /** The stream's bit rate on the wire, all headers counted, bit/s. */
  targetBitsPerSecond: number;
  /** Number of points in the raw cloud. */
  rawPoints: number;
  /** Bytes that the transport adds to each payload: RTP, SRTP, UDP, IP. */
  overheadBytes: number;
  /** The rate controller wants to probe the link with a train of this many bytes on the wire; 0 for none. */
  probeBytes: number;
  /** The most that those it is for can draw. */
  display?: DrawnMost | undefined;
  /** Somebody drives by what is seen: what delays a frame counts for more than its finest details. */
  prompt?: boolean | undefined;
  /** Time that the capture thread takes per frame, ms, with waiting for busy processors as far as it counts. */
  workMs: number;
  /** The rate at which clouds have really come of late, frames/s; `null` or left out while it is not known. */
  measuredFramesPerSecond?: number | null | undefined;
}

export type CodedFormat = Exclude<CloudFormat, 'points64'>;

/** Best first. */
export const CODED_FORMATS: readonly CodedFormat[] = ['organised', 'unorganised'];

export interface FramePlan {
  framesPerSecond: number;
  /** A multiple of whole packets. */
  points: number;
}

/** The plan for a coded format, whose bits per point depend on the frame. */
export interface CodedPlan {
  framesPerSecond: number;
  /** Bytes for the data of all packets. */
  budgetBytes: number;
  /** Whether a higher bit rate would make the frame finer. */
  limited: boolean;
}

/** Of `points64`. */
const BITS_PER_POINT = bitsOfBytes(BYTES_PER_POINT);
/** Fewer points do not make a picture of a room. The frame rate drops instead. Chosen by eye. */
const LEAST_POINTS = 3000;
const LEAST_BYTES = LEAST_POINTS;
/**
 * Lowest frame rate at which the world still appears to move, frames/s. Chosen; the guard's first interval
 * (operator-view.ts) and docs/awareness.md count on it.
 */
const LEAST_FRAMES_PER_SECOND = 10;
/**
 * A higher frame rate is chosen only if it can be kept when the link carries slightly less. Chosen: more than
 * an estimate moves on a steady link; plan.test.ts shows that rates do not alternate.
 */
const UPWARD_MARGIN = 1.25;
/**
 * The share of its time that the capture thread may spend on frames. It also reads commands and moves the
 * robot, and must not fall behind. Chosen: 30 % of an interval are left for the guard and late wake-ups.
 * `pnpm bench cpu` measures what a frame takes.
 */
const MOST_LOAD = 0.7;
/**
 * For a source without a fixed rate: on a fully loaded computer, each additional frame delays all of them.
 * 0.46 instead of 0.5: docs/decisions/2026-11-29-prompt-frames.md.
 */
const MOST_LOAD_AT_ANY_RATE = 0.46;
/** What a coded frame needs, bits per point of the raw cloud. */
interface CodedNeed {
  /** The frame is complete but coarse. Below this, the frame rate drops instead. */
  whole: number;
  /** As fine as a depth camera's own precision. While somebody drives, more is spent only where it hardly delays the frame. */
  good: number;
  /** Much finer than that. Any higher rate makes the stream faster, not finer. */
  enough: number;
}
const CODED_NEEDS: Readonly<Record<CodedFormat, CodedNeed>> = {
  // Camera frames within 0.5 mm · z², with colours at 34 dB, take 1.9 to 2.3 bits.
  organised: { whole: 1.6, good: 2, enough: 2.4 },
  // The step is fixed, so that only the number of points can change.
  unorganised: { whole: 16, good: 64, enough: 64 },
};
/**
 * While somebody drives, a frame that takes longer to send than this, ms, is not made finer than good. At
 * 41 Mbit/s the last fifth of its bytes costs 2.5 ms, and what it buys is hardly seen
 * (docs/decisions/2026-11-29-prompt-frames.md).
 */
const PROMPT_MS = 10;
/** A coded frame may turn out smaller than its budget by this factor; one that carries a probe train must not. */
const CODED_SLACK = 1.06;
/** So much more than a computer says it draws is no more. */
const DRAWN_SLACK = 1.1;
/** A measured rate from this share of the declared one on is the declared one: clocks and jitter differ by so much. */
const AS_DECLARED = 0.95;
/**
 * A probe may enlarge a frame by at most this factor. Chosen: a frame must not become a burst without bound.
 */
const MOST_PROBE_FACTOR = 8;

export class FramePlanner {
  readonly #options: PlanOptions;
  /** The last choice: one of so many frames of the source. */
  #divisor = 1;

  constructor(options: PlanOptions) {
    this.#options = options;
  }

  /** The plan for the frame that is being captured. */
  plan(input: PlanInput): FramePlan {
    const { policy, floorFraction } = this.#options;
    const { rawPoints } = input;
    const wireBytes = wireBytesOfPacket(input.overheadBytes);
    // Of a packet's bytes on the wire, only the points count in the equation.
    const pointBitsPerSecond = (input.targetBitsPerSecond * MAX_POINT_DATA_BYTES) / wireBytes;
    const most = this.#mostPoints(input);
    if (policy === 'paper') {
      const framesPerSecond = this.#mostFramesPerSecond(input);
      const planned = maxPoints({
        bitsPerSecond: pointBitsPerSecond,
        framesPerSecond,
        points: rawPoints,
        floorFraction,
      });
      return { framesPerSecond, points: Math.min(planned, most) };
    }
    const framesPerSecond = this.#chooseFrameRate(
      pointBitsPerSecond / BITS_PER_POINT,
      Math.min(most, rawPoints),
      input,
    );
    return { framesPerSecond, points: this.pointsAt(framesPerSecond, input) };
  }

  /** Points per frame at this frame rate: what the bit rate allows, or enough for the rate controller's probe train. */
  pointsAt(framesPerSecond: number, input: PlanInput): number {
    const wireBytes = wireBytesOfPacket(input.overheadBytes);
    const most = this.#mostPoints(input);
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
   * The plan for a frame in a coded format: as many whole frames per second as possible, each as fine as the bit rate
   * allows.
   */
  planCoded(format: CodedFormat, input: PlanInput): CodedPlan {
    const { rawPoints } = input;
    const need = CODED_NEEDS[format];
    const wireBytes = wireBytesOfPacket(input.overheadBytes);
    const dataShare = MAX_POINT_DATA_BYTES / wireBytes;
    const bitsPerSecond = input.targetBitsPerSecond * dataShare;
    const framesPerSecond = this.#chooseFrameRate(bitsPerSecond / need.whole, rawPoints, input, rawPoints);
    const points = this.#drawnPoints(format, input);
    const finest = bytesOfBits(points * need.enough);
    const prompt = Math.max(bytesOfBits(points * need.good), BitRate.bytesIn(bitsPerSecond, PROMPT_MS));
    const enough = input.prompt === true ? Math.min(prompt, finest) : finest;
    const afforded = Math.min(BitRate.toBytesPerSecond(bitsPerSecond) / framesPerSecond, enough);
    const probed = Math.min(
      input.probeBytes * dataShare * CODED_SLACK,
      MOST_PROBE_FACTOR * Math.max(afforded, LEAST_BYTES),
    );
    const budgetBytes = Math.floor(Math.max(afforded, probed, MAX_POINT_DATA_BYTES));
    return { framesPerSecond, budgetBytes, limited: budgetBytes < Math.floor(enough) };
  }

  /** What so many packets' worth of data takes on the wire, all headers counted, bits. */
  wireBits(packets: number, { overheadBytes }: PlanInput): number {
    return bitsOfBytes(packets * wireBytesOfPacket(overheadBytes));
  }

  /** The highest bit rate that frames like this one can use, all headers counted, bit/s. */
  usefulBitsPerSecond(format: CloudFormat, input: PlanInput): number {
    const bits =
      format === 'points64'
        ? Math.min(input.rawPoints, this.#mostPoints(input)) * BITS_PER_POINT
        : this.#drawnPoints(format, input) * CODED_NEEDS[format].enough;
    const wireBytes = wireBytesOfPacket(input.overheadBytes);
    return (bits * this.#mostFramesPerSecond(input) * wireBytes) / MAX_POINT_DATA_BYTES;
  }

  /** Points of a frame that a coded format is to carry. A depth camera's frame is whole, or it has holes. */
  #drawnPoints(format: CodedFormat, { rawPoints, display }: PlanInput): number {
    return format === 'organised' ? rawPoints : Math.min(rawPoints, display?.points ?? rawPoints);
  }

  /** Of a sample, in whole packets. */
  #mostPoints({ display }: PlanInput): number {
    const most = Math.min(this.#options.mostPoints, display?.points ?? Number.POSITIVE_INFINITY);
    return Math.max(Math.floor(most / POINTS_PER_PACKET), 1) * POINTS_PER_PACKET;
  }

  #mostFramesPerSecond(input: PlanInput): number {
    return Math.min(
      this.#sourceFramesPerSecond(input),
      input.display?.framesPerSecond ?? Number.POSITIVE_INFINITY,
    );
  }

  /**
   * The rate at which frames come. A budget made for more frames than come would be used only in part: the frames
   * would be too small, and whoever measures what arrives would take that for all that the link carries.
   */
  #sourceFramesPerSecond({ measuredFramesPerSecond, workMs }: PlanInput): number {
    const { mostFramesPerSecond, anyRate } = this.#options;
    // A source that is asked gives no more than there is time to take.
    if (anyRate) return workMs > 0 ? Math.min(mostFramesPerSecond, 1000 / workMs) : mostFramesPerSecond;
    const measured = measuredFramesPerSecond ?? mostFramesPerSecond;
    return measured >= mostFramesPerSecond * AS_DECLARED ? mostFramesPerSecond : measured;
  }

  /**
   * The source's rate, or a whole fraction of it: a camera can give every second picture, but not every 1.3rd. For a
   * source that gives a frame whenever it is asked, as many as there is time for.
   */
  #chooseFrameRate(
    pointsPerSecond: number,
    mostPoints: number,
    input: PlanInput,
    wanted = LEAST_POINTS,
  ): number {
    const { mostFramesPerSecond, anyRate } = this.#options;
    const { workMs } = input;
    const sourceRate = anyRate ? mostFramesPerSecond : this.#sourceFramesPerSecond(input);
    // A measured rate is not exact: a third of 28 frames/s is as good as 10.
    const accuracy = sourceRate < mostFramesPerSecond ? AS_DECLARED : 1;
    const drawn = this.#mostFramesPerSecond(input);
    const floor = Math.min(LEAST_FRAMES_PER_SECOND, drawn) * accuracy;
    const least = Math.min(wanted, mostPoints);
    const load = anyRate ? MOST_LOAD_AT_ANY_RATE : MOST_LOAD;
    const affordable = workMs > 0 ? (1000 * load) / workMs : Number.POSITIVE_INFINITY;
    for (let divisor = 1; ; divisor++) {
      const candidate = sourceRate / divisor;
      const next = sourceRate / (divisor + 1);
      const margin = divisor < this.#divisor ? UPWARD_MARGIN : 1;
      // A source with a rate of its own gives the next whole fraction of it that can be drawn.
      if (!anyRate && candidate > drawn * DRAWN_SLACK) continue;
      const inTime = anyRate || candidate * (margin === 1 ? 1 : 1.1) <= affordable;
      // A source that is asked may have no time for the candidate: then its frames are larger.
      const rate = anyRate ? Math.max(Math.min(candidate, affordable, drawn), floor) : candidate;
      const fits = pointsPerSecond / rate >= least * margin && inTime;
      if (!fits && next >= floor) continue;
      this.#divisor = divisor;
      return rate;
    }
  }
}

/** Size of a full packet with all its headers, bytes. */
export function wireBytesOfPacket(overheadBytes: number): number {
  return POINT_PACKET_HEADER_BYTES + MAX_POINT_DATA_BYTES + PLACEMENT_BYTES + overheadBytes;
}
