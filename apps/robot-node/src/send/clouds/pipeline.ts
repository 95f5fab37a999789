/**
 * The way of a cloud on the main thread, from the capture thread (sense/capture/pipeline.ts) to the wire:
 *
 * 1. count it, and drop it if it is stale,
 * 2. share its packets among all who want them and read their format (transport/shared-frame.ts, frame-receiver.ts),
 * 3. queue them in each receiver's pacer (transport/stream-sender.ts, packages/congestion),
 * 4. send what is due (transport/send-loop.ts), sealed and numbered for each path (transport/srtp-transport.ts).
 *
 * On the operator's side, packages/operator/src/cloud/pipeline.ts goes on.
 */
import { FRESH_FRAME_MS } from '../../ground/outgoing-frame.ts';
import type { RobotCounters } from '../../ground/robot-counters.ts';
import type { StageTimer } from '../../ground/stage-timer.ts';
import type { Capture } from '../../sense/capture/capture.ts';
import type { ReadyFrame } from '../../sense/capture/capture-messages.ts';
import type { CodedStream } from '../../sense/encode/coded-frame-encoder.ts';
import type { FrameAudience } from '../../sense/encode/frame-formats.ts';
import type { BudgetTarget } from '../budgets/sensor-budget.ts';
import type { SendLoop } from '../transport/send-loop.ts';
import { SharedFrame } from '../transport/shared-frame.ts';
import type { FrameLog } from './frame-log.ts';

/** A receiver of frames, of either protocol. */
export interface FrameTarget extends BudgetTarget {
  enqueue(shared: SharedFrame): void;
  /** Sends the header that a coded stream's frames are decoded with, to operators who read the format. */
  announce?(stream: CodedStream, sensor: number): void;
}

export interface SendPipelineOptions {
  /** The sensor's number. */
  sensor: number;
  /** The pacer's lane: packets in a lower lane leave first. */
  lane: number;
  capture: Pick<Capture, 'onFrame' | 'onStream' | 'recycle' | 'requestLatencyTest'>;
  targets: () => Iterable<FrameTarget>;
  sendLoop: Pick<SendLoop, 'run'>;
  /** Bytes that the transport adds to each payload. */
  overheadBytes: () => number;
  counters: RobotCounters;
  stages: StageTimer;
  frameLog?: Pick<FrameLog, 'add'> | undefined;
  onFrame?: ((frame: ReadyFrame) => void) | undefined;
  now: () => number;
}

/** Hands each frame, which is encoded once for all operators, to everyone who wants it and reads its format. */
export class SendPipeline {
  readonly #options: SendPipelineOptions;
  #stream: CodedStream | null = null;

  constructor(options: SendPipelineOptions) {
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

  #onFrame(frame: ReadyFrame): void {
    const { capture, targets, sendLoop, counters, stages, now, sensor, lane } = this.#options;
    counters.frame(frame);
    this.#options.frameLog?.add(frame);
    this.#options.onFrame?.(frame);
    stages.add('captureMs', frame.captureMs);
    stages.add('sampleMs', frame.sampleMs);
    stages.add('packMs', frame.packMs);
    const shared = new SharedFrame(
      frame,
      this.#options.overheadBytes(),
      (buffer) => capture.recycle(buffer),
      lane,
    );
    if (now() - frame.capturedAtMs > FRESH_FRAME_MS) {
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
