import type { CaptureRoom, SourceDescription, SourceFrame } from '@farpoint/cloud-source';
import { MAX_POINT_DATA_BYTES } from '@farpoint/protocol';
import type { Codec } from '@farpoint/wasm-codec';
import type { CaptureBudget } from './capture-budget.ts';
import { CodedFrameEncoder, type CodedStream } from './coded-frame-encoder.ts';
import type { EncodedFrame, EncoderOptions, PacketSource } from './encoded-frame.ts';
import type { CodedFormat, CodedPlan, FramePlanner, PlanInput } from './plan.ts';
import { Points64FrameEncoder } from './points64-frame-encoder.ts';
import { UsefulRate } from './useful-rate.ts';

/** The operators that a frame is for: those who read a coded format, those who do not, or everyone. */
export type FrameAudience = 'everyone' | { readers: CodedFormat } | { others: CodedFormat };

export interface FormattedFrame {
  encoded: EncodedFrame;
  audience: FrameAudience;
  packets: Pick<PacketSource, 'copyPackets'>;
}

export interface FormatRequest {
  frameNumber: number;
  budget: CaptureBudget;
  /** Bytes of the packet train that the rate controller wants; 0 for none. */
  probeBytes: number;
  /** Time that the capture thread takes per frame, ms. */
  workMs: number;
  /** Clouds per second that really come; `null` while that is not known. */
  measuredFramesPerSecond: number | null;
  latencyTest: boolean;
}

export interface FormattedFrames {
  /** Planned time until the next frame, ms. */
  intervalMs: number;
  /** The highest bit rate that frames like this one could use, bit/s on the wire. */
  usefulBitsPerSecond: number;
  frames: FormattedFrame[];
}

/** Encodes a frame once for each format that somebody reads. */
export class FrameFormats {
  readonly #planner: FramePlanner;
  readonly #useful = new UsefulRate();
  readonly #points64: Points64FrameEncoder;
  readonly #makeCoded: () => CodedFrameEncoder;
  /** Created when first needed, because it takes megabytes of memory. */
  #coded: CodedFrameEncoder | null = null;

  constructor(
    codec: Codec,
    source: SourceDescription,
    sampling: Omit<EncoderOptions, 'depthMeasure'>,
    planner: FramePlanner,
    now: () => number,
  ) {
    const options = { ...sampling, depthMeasure: source.depthMeasure };
    this.#planner = planner;
    this.#points64 = new Points64FrameEncoder(codec, source, options, now);
    this.#makeCoded = () => new CodedFrameEncoder(codec, source, options, now);
  }

  /** What receivers of coded frames need. A new object whenever it changes. */
  get stream(): CodedStream | null {
    return this.#coded?.stream ?? null;
  }

  /** Codec memory for the next frame. @param coded whether it will be encoded in a coded format */
  room(coded: boolean): CaptureRoom {
    // Create the encoder before a frame lies in the codec's memory, because creating it may move that memory.
    if (coded) this.#coded ??= this.#makeCoded();
    return (coded ? this.#coded : null)?.room ?? this.#points64.room;
  }

  /**
   * The packets of each of `frames` remain in its encoder until the next call.
   *
   * @throws {CodecError} for a frame beyond the source's capacity
   */
  encode(frame: SourceFrame, request: FormatRequest): FormattedFrames {
    const { frameNumber, budget, probeBytes, workMs, measuredFramesPerSecond, latencyTest } = request;
    const rawPoints = frame.form === 'points' ? frame.count : frame.depth.length;
    const input = { ...budget, probeBytes, rawPoints, workMs, measuredFramesPerSecond };
    const coded = this.#encodeCoded(frame, request, input);
    if (coded === null) {
      const { framesPerSecond, points } = this.#planner.plan(input);
      const encoded = this.#points64.encode(frame, frameNumber, points, latencyTest);
      return {
        intervalMs: 1000 / framesPerSecond,
        usefulBitsPerSecond: this.#planner.usefulBitsPerSecond('points64', input),
        frames: [{ encoded, audience: 'everyone', packets: this.#points64 }],
      };
    }
    const { formatted, format, framesPerSecond } = coded;
    const frames: FormattedFrame[] = [formatted];
    const plain = budget.coded.find((one) => one.format === format)?.plainBitsPerSecond ?? null;
    if (plain !== null) {
      // Use the coded stream's frame rate: `points64` takes enough of the link as it is.
      const points = this.#planner.pointsAt(framesPerSecond, { ...input, targetBitsPerSecond: plain });
      const encoded = this.#points64.encode(frame, frameNumber, points, latencyTest);
      frames.push({ encoded, audience: { others: format }, packets: this.#points64 });
    }
    const usefulBitsPerSecond = this.#useful.update({
      wireBits: this.#planner.wireBits(formatted.encoded.packets, input),
      budgetBits: this.#planner.wireBits(coded.budgetBytes / MAX_POINT_DATA_BYTES, input),
      limited: coded.limited,
      framesPerSecond,
      mostBitsPerSecond: this.#planner.usefulBitsPerSecond(format, input),
    });
    return { intervalMs: 1000 / framesPerSecond, usefulBitsPerSecond, frames };
  }

  /** @returns `null` if nobody reads a coded format that fits the frame */
  #encodeCoded(
    frame: SourceFrame,
    { frameNumber, budget, latencyTest }: FormatRequest,
    input: PlanInput,
  ): ({ formatted: FormattedFrame; format: CodedFormat } & CodedPlan) | null {
    if (budget.coded.length === 0) return null;
    this.#coded ??= this.#makeCoded();
    const allowed = budget.coded.map(({ format }) => format);
    const likely = budget.coded.find(({ format }) => format === this.#coded?.likelyFormat(allowed));
    if (likely === undefined) return null;
    const { targetBitsPerSecond } = likely;
    const plan = this.#planner.planCoded(likely.format, { ...input, targetBitsPerSecond });
    const encoded = this.#coded.encode(frame, frameNumber, allowed, plan.budgetBytes, latencyTest);
    if (encoded === null) return null;
    const format = encoded.format as CodedFormat;
    const formatted: FormattedFrame = { encoded, audience: { readers: format }, packets: this.#coded };
    return { formatted, format, ...plan };
  }
}
