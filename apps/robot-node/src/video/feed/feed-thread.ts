import { Worker } from 'node:worker_threads';
import type { Logger } from '@farpoint/service';
import { Backoff } from '@farpoint/timing';
import type { VideoEncoder as EncoderElement } from '@farpoint/video';
import type { VideoEncoder, VideoEncoderEvents } from '../video-encoder.ts';
import type { EncodedFormat } from '../video-plan.ts';
import type { FeedReport, FeedRequest, RunId } from './feed-messages.ts';
import type { FeedSource } from './feed-source.ts';

const RETRY = { firstMs: 500, mostMs: 10_000 };
/** A thread that has lived for so long has succeeded: the next wait is short again, ms. */
const SUCCESS_MS = 10_000;
/** By then, a thread that was told to end has closed everything, ms. */
const END_MS = 5000;

export interface FedCamera {
  name: string;
  source: FeedSource;
  encoder: EncoderElement;
}

/** A camera that is open, whether or not the thread runs at present. */
interface Run {
  readonly camera: FedCamera;
  readonly events: VideoEncoderEvents;
  readonly log: Logger;
  readonly closed: PromiseWithResolvers<void>;
  format: EncodedFormat;
  closing: boolean;
  dropped: number;
  /** In threads that have ended. */
  droppedBefore: number;
}

/** The main thread's end of the thread that feeds cameras. It runs while one of them is open, and again if it dies. */
export class FeedThread {
  readonly #log: Logger;
  readonly #script: URL;
  readonly #backoff: Backoff;
  readonly #runs = new Map<RunId, Run>();
  #worker: Worker | null = null;
  #restart: NodeJS.Timeout | null = null;
  #nextRun: RunId = 0;
  #restarts = 0;

  constructor(log: Logger, { script = new URL('./feed-worker.ts', import.meta.url), retry = RETRY } = {}) {
    this.#log = log;
    this.#script = script;
    this.#backoff = new Backoff({ ...retry, random: Math.random });
  }

  /** How often it had to be started again. */
  get restarts(): number {
    return this.#restarts;
  }

  open(camera: FedCamera, format: EncodedFormat, events: VideoEncoderEvents): VideoEncoder {
    const id = this.#nextRun++;
    const run: Run = {
      ...{ camera, format, events, log: this.#log.child({ camera: camera.name }) },
      ...{ closed: Promise.withResolvers<void>(), dropped: 0, droppedBefore: 0 },
      closing: false,
    };
    this.#runs.set(id, run);
    if (this.#worker !== null) this.#begin(id, run);
    else if (this.#restart === null) this.#start();
    return {
      configure: (next) => {
        run.format = next;
        this.#ask({ type: 'configure', run: id, format: next });
      },
      requestKeyFrame: () => this.#ask({ type: 'key-frame', run: id }),
      get dropped() {
        return run.droppedBefore + run.dropped;
      },
      close: () => this.#close(id, run),
    };
  }

  #ask(request: FeedRequest): void {
    this.#worker?.postMessage(request);
  }

  #begin(run: RunId, { camera, format }: Run): void {
    this.#ask({ type: 'open', run, ...camera, format });
  }

  #close(id: RunId, run: Run): Promise<void> {
    run.closing = true;
    // Without a thread there is nothing to wait for.
    if (this.#worker === null) this.#closed(id);
    else this.#ask({ type: 'close', run: id });
    return run.closed.promise;
  }

  /** A thread that nobody needs ends, and with it its nodes in ROS graphs. */
  #closed(id: RunId): void {
    this.#runs.get(id)?.closed.resolve();
    this.#runs.delete(id);
    if (this.#runs.size > 0) return;
    if (this.#restart !== null) clearTimeout(this.#restart);
    this.#restart = null;
    const worker = this.#worker;
    this.#worker = null;
    if (worker === null) return;
    worker.postMessage({ type: 'end' } satisfies FeedRequest);
    setTimeout(() => void worker.terminate(), END_MS).unref();
  }

  #start(): void {
    const worker = new Worker(this.#script);
    const startedMs = performance.now();
    let reason = 'it ended';
    this.#restart = null;
    this.#worker = worker;
    worker.on('message', (report: FeedReport) => {
      if (this.#worker === worker) this.#onReport(report);
    });
    worker.on('error', (error) => {
      reason = error.message;
      this.#log.error({ err: error }, 'the thread that feeds cameras failed');
    });
    worker.on('exit', () => {
      if (this.#worker !== worker) return;
      if (performance.now() - startedMs > SUCCESS_MS) this.#backoff.reset();
      this.#onDeath(reason);
    });
    for (const [id, run] of this.#runs) this.#begin(id, run);
  }

  #onDeath(reason: string): void {
    this.#worker = null;
    for (const [id, run] of this.#runs) if (run.closing) this.#closed(id);
    if (this.#runs.size === 0) return;
    this.#restarts++;
    this.#restart = setTimeout(() => this.#start(), this.#backoff.nextMs());
    for (const run of this.#runs.values()) {
      run.droppedBefore += run.dropped;
      run.dropped = 0;
      run.events.onFault(
        `the thread that feeds ROS and simulated cameras has ended: ${reason}; it starts again`,
      );
    }
  }

  #onReport(report: FeedReport): void {
    const run = this.#runs.get(report.run);
    if (run === undefined) return;
    if (report.type === 'picture') {
      // The new thread knows nothing of the end of the one before.
      run.events.onFault(null);
      run.events.onPicture(report.picture);
    } else if (report.type === 'fault') run.events.onFault(report.fault);
    else if (report.type === 'dropped') run.dropped = report.dropped;
    else if (report.type === 'log') run.log[report.level](report.fields, report.message);
    else this.#closed(report.run);
  }
}
