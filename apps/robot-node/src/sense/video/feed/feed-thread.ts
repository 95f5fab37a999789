import { Worker } from 'node:worker_threads';
import type { Logger } from '@farpoint/service';
import { Backoff, Heartbeat, MEDIA_RETRY, MEDIA_SIGNS_OF_LIFE, MEDIA_SUCCESS_MS } from '@farpoint/timing';
import type { VideoEncoder as EncoderElement } from '@farpoint/video';
import type { VideoEncoder, VideoEncoderEvents, VideoFaultReason } from '../video-encoder.ts';
import type { EncodedFormat } from '../video-plan.ts';
import type { FeedReport, FeedRequest, RunId } from './feed-messages.ts';
import type { FeedSource } from './feed-source.ts';

/**
 * By then, a thread that was told to end has closed everything, ms. Chosen: as long as its silence may last.
 */
const END_MS = MEDIA_SIGNS_OF_LIFE.silenceMs;

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
  #heartbeat: Heartbeat | null = null;
  #checking: NodeJS.Timeout | null = null;
  #restart: NodeJS.Timeout | null = null;
  readonly #life: typeof MEDIA_SIGNS_OF_LIFE;
  #nextRun: RunId = 0;
  #restarts = 0;

  constructor(
    log: Logger,
    {
      script = new URL('./feed-worker.ts', import.meta.url),
      retry = MEDIA_RETRY,
      life = MEDIA_SIGNS_OF_LIFE,
    } = {},
  ) {
    this.#life = life;
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
      camera,
      format,
      events,
      log: this.#log.child({ camera: camera.name }),
      closed: Promise.withResolvers<void>(),
      dropped: 0,
      droppedBefore: 0,
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
    this.#forgetWorker();
    if (worker === null) return;
    worker.postMessage({ type: 'end' } satisfies FeedRequest);
    setTimeout(() => void worker.terminate(), END_MS).unref();
  }

  #start(): void {
    const worker = new Worker(this.#script, { name: 'video feed' });
    const startedMs = performance.now();
    let reason = 'it ended';
    this.#restart = null;
    this.#worker = worker;
    this.#heartbeat = new Heartbeat(this.#life, performance.now());
    this.#checking = setInterval(() => this.#checkLife(startedMs), this.#life.checkMs).unref();
    worker.on('message', (report: FeedReport) => {
      if (this.#worker === worker) this.#onReport(report);
    });
    worker.on('error', (error) => {
      reason = error.message;
      this.#log.error({ err: error }, 'the thread that feeds cameras failed');
    });
    worker.on('exit', () => {
      if (this.#worker !== worker) return;
      this.#onDeath('feed-ended', `has ended: ${reason}`, startedMs);
    });
    for (const [id, run] of this.#runs) this.#begin(id, run);
  }

  /** A thread that hangs is not waited for: it may hang in an addon, where nothing can end it. */
  #checkLife(startedMs: number): void {
    const [worker, heartbeat] = [this.#worker, this.#heartbeat];
    if (worker === null || heartbeat?.isLost(performance.now()) !== true) return;
    const seconds = Math.round(heartbeat.silentMs / 1000);
    this.#log.error({ seconds }, 'the thread that feeds cameras hangs');
    this.#onDeath('feed-hung', `has said nothing for ${seconds} s`, startedMs);
    void worker.terminate();
  }

  #forgetWorker(): void {
    this.#worker = null;
    this.#heartbeat = null;
    if (this.#checking !== null) clearInterval(this.#checking);
    this.#checking = null;
  }

  #onDeath(reason: VideoFaultReason, what: string, startedMs: number): void {
    this.#forgetWorker();
    if (performance.now() - startedMs > MEDIA_SUCCESS_MS) this.#backoff.reset();
    for (const [id, run] of this.#runs) if (run.closing) this.#closed(id);
    if (this.#runs.size === 0) return;
    this.#restarts++;
    this.#restart = setTimeout(() => this.#start(), this.#backoff.nextMs());
    for (const run of this.#runs.values()) {
      run.droppedBefore += run.dropped;
      run.dropped = 0;
      run.events.onFault(`the thread that feeds ROS and simulated cameras ${what}; it starts again`, reason);
    }
  }

  #onReport(report: FeedReport): void {
    this.#heartbeat?.beat();
    if (report.type === 'alive') return;
    const run = this.#runs.get(report.run);
    if (run === undefined) return;
    if (report.type === 'picture') {
      // The new thread knows nothing of the end of the one before.
      run.events.onFault(null);
      run.events.onPicture(report.picture);
    } else if (report.type === 'fault') run.events.onFault(report.fault, report.reason);
    else if (report.type === 'dropped') run.dropped = report.dropped;
    else if (report.type === 'log') run.log[report.level](report.fields, report.message);
    else this.#closed(report.run);
  }
}
