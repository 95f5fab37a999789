import type { Capture } from '../capture/capture.ts';
import { type CaptureBudget, type CapturedFrame, NO_BUDGET } from '../capture/capture-messages.ts';
import type { CodedStream } from '../encode/coded-frame-encoder.ts';
import type { FrameLog } from '../telemetry/frame-log.ts';
import type { RobotCounters } from '../telemetry/robot-counters.ts';
import type { StageTimer } from '../telemetry/stage-timer.ts';
import type { SendLoop } from '../transport/send-loop.ts';
import { SharedFrame } from '../transport/shared-frame.ts';
import type { StreamSender } from '../transport/stream-sender.ts';

/** A frame that is older than this when it comes out of the worker is not worth sending. */
const MAX_FRAME_AGE_MS = 250;

/** Whom frames go to, whatever protocol it speaks. */
export interface FrameTarget {
  /** As the guard knows it. */
  readonly id: string;
  readonly streaming: boolean;
  /** What points may take of its path, bit/s on the wire. */
  readonly cloudBitsPerSecond: number;
  /** Reads coded formats. */
  readonly takesCoded: boolean;
  readonly sender: Pick<StreamSender, 'probeWish' | 'overheadBytes'> | null;
  enqueue(shared: SharedFrame): void;
  /** What coded frames are decoded with; told to those who read them. */
  announce?(stream: CodedStream): void;
}

export interface FanOutOptions {
  capture: Capture;
  targets: () => Iterable<FrameTarget>;
  sendLoop: SendLoop;
  /** Whose path decides how much is captured; `null` where nobody drives. */
  driver: () => string | null;
  counters: RobotCounters;
  stages: StageTimer;
  frameLog?: Pick<FrameLog, 'add'> | undefined;
  now: () => number;
  /** Coded formats may be used. */
  mayCode: boolean;
}

/** One encode for all: each captured frame goes to every operator who wants it, and their paths decide its size. */
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

  /** Tells what coded frames are decoded with, where there are any and the target reads them. */
  announceTo(target: FrameTarget): void {
    if (this.#stream !== null && target.takesCoded) target.announce?.(this.#stream);
  }

  /**
   * Tells the worker how much to capture and in which format, where that changed. The driver's path decides; without a
   * driver the narrowest does. Operators with slower paths skip frames. Those who do not read what the driver reads get
   * `points64` beside it.
   */
  updateBudget(): void {
    const { capture, targets, driver, mayCode } = this.#options;
    const streaming = [...targets()].filter((operator) => operator.streaming);
    const driving = streaming.find((operator) => operator.id === driver());
    const driven = driving === undefined ? streaming : [driving];
    const coded = mayCode && driven.some(({ takesCoded }) => takesCoded);
    const deciding = coded ? driven.filter(({ takesCoded }) => takesCoded) : driven;
    const plain = coded ? streaming.filter(({ takesCoded }) => !takesCoded) : [];
    // One path at a time can be tried with larger frames: they go to everyone.
    const probe = deciding.length === 1 ? (deciding[0]?.sender?.probeWish ?? null) : null;
    const next: CaptureBudget = {
      coded,
      plainBitsPerSecond: plain.length === 0 ? null : narrowest(plain),
      targetBitsPerSecond: deciding.length === 0 ? 0 : narrowest(deciding),
      probe: probe === null ? null : { clusterId: probe.clusterId, bytes: probe.bytes },
      overheadBytes: Math.max(0, ...streaming.map((operator) => operator.sender?.overheadBytes ?? 0)),
      streaming: streaming.length > 0,
    };
    const last = this.#budget;
    if (
      next.probe?.clusterId === last.probe?.clusterId &&
      next.targetBitsPerSecond === last.targetBitsPerSecond &&
      next.overheadBytes === last.overheadBytes &&
      next.coded === last.coded &&
      next.plainBitsPerSecond === last.plainBitsPerSecond &&
      next.streaming === last.streaming
    ) {
      return;
    }
    this.#budget = next;
    capture.setBudget(next);
  }

  #onFrame(frame: CapturedFrame): void {
    const { capture, targets, sendLoop, counters, stages, now } = this.#options;
    counters.frame(frame);
    this.#options.frameLog?.add(frame);
    stages.add('captureMs', frame.captureMs);
    stages.add('sampleMs', frame.sampleMs);
    stages.add('packMs', frame.packMs);
    const shared = new SharedFrame(frame, this.#budget.overheadBytes, (buffer) => capture.recycle(buffer));
    if (now() - frame.capturedAtMs > MAX_FRAME_AGE_MS) {
      counters.framesStale++;
      if (frame.latencyTest) capture.requestLatencyTest();
    } else {
      const { audience } = frame;
      for (const target of targets()) {
        if (audience === 'everyone' || (audience === 'coded') === target.takesCoded) target.enqueue(shared);
      }
    }
    shared.release();
    sendLoop.run();
  }
}

function narrowest(targets: readonly FrameTarget[]): number {
  return Math.min(...targets.map((target) => target.cloudBitsPerSecond));
}
