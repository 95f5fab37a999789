import { isDeepStrictEqual } from 'node:util';
import type { RobotCounters } from '../../ground/robot-counters.ts';
import type { StageTimer } from '../../ground/stage-timer.ts';
import type { Capture } from '../../sense/capture/capture.ts';
import type { ReadyFrame } from '../../sense/capture/capture-messages.ts';
import {
  type CaptureBudget,
  type CodedBudget,
  NO_BUDGET,
  UNSENT_BUDGET,
} from '../../sense/encode/capture-budget.ts';
import type { CodedStream } from '../../sense/encode/coded-frame-encoder.ts';
import type { FrameAudience } from '../../sense/encode/frame-formats.ts';
import { CODED_FORMATS, type CodedFormat, type DrawnMost } from '../../sense/encode/plan.ts';
import type { SendLoop } from '../transport/send-loop.ts';
import { SharedFrame } from '../transport/shared-frame.ts';
import type { StreamSender } from '../transport/stream-sender.ts';
import type { FrameLog } from './frame-log.ts';

/** A frame older than this when it leaves the worker is not sent. */
const MAX_FRAME_AGE_MS = 250;

/** A receiver of frames, of either protocol. */
export interface FrameTarget {
  /** The name by which the guard knows the operator. */
  readonly id: string;
  readonly streaming: boolean;
  /** Whether the operator wants this sensor's clouds. */
  wants(sensor: number): boolean;
  /** How much of the operator's path this sensor's clouds may take, bit/s on the wire. */
  cloudBitsPerSecond(sensor: number): number;
  /** Whether this sensor's frames are enlarged when the path's rate control probes for a higher rate. */
  probesWith(sensor: number): boolean;
  reads(format: CodedFormat): boolean;
  readonly sender: Pick<StreamSender, 'probeWish' | 'overheadBytes'> | null;
  /** The most that the operator's computer draws; left out or `null`: all that comes. */
  readonly display?: DrawnMost | null;
  enqueue(shared: SharedFrame): void;
  /** Sends the header that a coded stream's frames are decoded with, to operators who read the format. */
  announce?(stream: CodedStream, sensor: number): void;
}

export interface FanOutOptions {
  /** The sensor's number. */
  sensor: number;
  /** The pacer's lane: packets in a lower lane leave first. */
  lane: number;
  capture: Pick<Capture, 'onFrame' | 'onStream' | 'setBudget' | 'recycle' | 'requestLatencyTest'>;
  targets: () => Iterable<FrameTarget>;
  sendLoop: Pick<SendLoop, 'run'>;
  /** The operator whose path decides how much is captured; `null` if nobody drives. */
  driver: () => string | null;
  counters: RobotCounters;
  stages: StageTimer;
  frameLog?: Pick<FrameLog, 'add'> | undefined;
  onFrame?: ((frame: ReadyFrame) => void) | undefined;
  /** Whether live viewers want the clouds even if no operator does. */
  wantedAnyway?: (() => boolean) | undefined;
  now: () => number;
  /** Whether coded formats may be used. */
  mayCode: boolean;
}

/** Encodes each frame once for all operators: it goes to everyone who wants it, and their paths decide its size. */
export class FrameFanOut {
  readonly #options: FanOutOptions;
  #budget: CaptureBudget = NO_BUDGET;
  #stream: CodedStream | null = null;

  constructor(options: FanOutOptions) {
    this.#options = options;
    options.capture.onFrame = (frame) => this.#onFrame(frame);
    options.capture.onStream = (stream) => {
      this.#stream = stream;
      for (const target of options.targets()) this.announceTo(target);
    };
  }

  /** Sends the coded stream's header to a target, if there is a stream and the target wants and reads it. */
  announceTo(target: FrameTarget): void {
    const { sensor } = this.#options;
    if (this.#stream === null || !target.wants(sensor) || !target.reads(this.#stream.format)) return;
    target.announce?.(this.#stream, sensor);
  }

  /**
   * Tells the worker how much to capture and in which formats, if that has changed. The driver decides. If nobody
   * drives, all watchers decide together: every format that any of them reads may be used, at the rate of the slowest
   * path among its readers. Operators with slower paths skip frames. Operators who cannot read a frame's format get
   * `points64` in parallel.
   */
  updateBudget(): void {
    const { targets, driver, mayCode, sensor } = this.#options;
    const streaming = [...targets()].filter((operator) => operator.streaming && operator.wants(sensor));
    if (streaming.length === 0) {
      this.#tell(this.#options.wantedAnyway?.() === true ? UNSENT_BUDGET : NO_BUDGET);
      return;
    }
    const driving = streaming.find((operator) => operator.id === driver());
    const driven = driving === undefined ? streaming : [driving];
    const coded = mayCode
      ? CODED_FORMATS.flatMap((format) => codedBudget(format, sensor, driven, streaming))
      : [];
    const readers = driven.filter((target) => coded.some(({ format }) => target.reads(format)));
    const deciding = readers.length > 0 ? readers : driven;
    // Only one path can be probed at a time, because the enlarged frames go to everyone.
    const [only] = deciding;
    const probing = deciding.length === 1 && only?.probesWith(sensor) === true;
    const probe = probing ? (only.sender?.probeWish ?? null) : null;
    const display = mostDrawn(deciding);
    const next: CaptureBudget = {
      coded,
      ...(display === null ? {} : { display }),
      targetBitsPerSecond: narrowest(deciding, sensor),
      probe: probe === null ? null : { clusterId: probe.clusterId, bytes: probe.bytes },
      overheadBytes: Math.max(0, ...streaming.map((operator) => operator.sender?.overheadBytes ?? 0)),
      streaming: true,
      ...(driving === undefined ? {} : { prompt: true }),
    };
    this.#tell(next);
  }

  #tell(next: CaptureBudget): void {
    const last = this.#budget;
    if (
      next.probe?.clusterId === last.probe?.clusterId &&
      next.targetBitsPerSecond === last.targetBitsPerSecond &&
      next.overheadBytes === last.overheadBytes &&
      isDeepStrictEqual(next.coded, last.coded) &&
      isDeepStrictEqual(next.display, last.display) &&
      next.streaming === last.streaming &&
      next.prompt === last.prompt &&
      next.unsent === last.unsent
    ) {
      return;
    }
    this.#budget = next;
    this.#options.capture.setBudget(next);
  }

  #onFrame(frame: ReadyFrame): void {
    const { capture, targets, sendLoop, counters, stages, now, sensor, lane } = this.#options;
    counters.frame(frame);
    this.#options.frameLog?.add(frame);
    this.#options.onFrame?.(frame);
    stages.add('captureMs', frame.captureMs);
    stages.add('sampleMs', frame.sampleMs);
    stages.add('packMs', frame.packMs);
    const { overheadBytes } = this.#budget;
    const shared = new SharedFrame(frame, overheadBytes, (buffer) => capture.recycle(buffer), lane);
    if (now() - frame.capturedAtMs > MAX_FRAME_AGE_MS) {
      counters.framesStale++;
      if (frame.latencyTest) capture.requestLatencyTest();
    } else {
      for (const target of targets()) {
        if (target.wants(sensor) && isFor(target, frame.audience)) target.enqueue(shared);
      }
    }
    shared.release();
    sendLoop.run();
  }
}

function isFor(target: FrameTarget, audience: FrameAudience): boolean {
  if (audience === 'everyone') return true;
  return 'readers' in audience ? target.reads(audience.readers) : !target.reads(audience.others);
}

/** What the fastest of them draws; `null` if one draws all that comes. */
function mostDrawn(targets: readonly FrameTarget[]): DrawnMost | null {
  const most = { framesPerSecond: 0, points: 0 };
  for (const { display } of targets) {
    if (display == null) return null;
    most.framesPerSecond = Math.max(most.framesPerSecond, display.framesPerSecond);
    most.points = Math.max(most.points, display.points);
  }
  return targets.length === 0 ? null : most;
}

/** Empty if none of the deciding operators reads the format. */
function codedBudget(
  format: CodedFormat,
  sensor: number,
  deciding: readonly FrameTarget[],
  streaming: readonly FrameTarget[],
): CodedBudget[] {
  const readers = deciding.filter((target) => target.reads(format));
  if (readers.length === 0) return [];
  const others = streaming.filter((target) => !target.reads(format));
  const plainBitsPerSecond = others.length === 0 ? null : narrowest(others, sensor);
  return [{ format, targetBitsPerSecond: narrowest(readers, sensor), plainBitsPerSecond }];
}

function narrowest(targets: readonly FrameTarget[], sensor: number): number {
  return Math.min(...targets.map((target) => target.cloudBitsPerSecond(sensor)));
}
