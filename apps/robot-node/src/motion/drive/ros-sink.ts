import { Worker } from 'node:worker_threads';
import { isZeroTwist, type Twist } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import type { Logger } from '@farpoint/service';
import { Backoff } from '@farpoint/timing';
import { monotonicMs } from '../../ground/clock.ts';
import {
  CHECK_MS,
  CLOSE_MS,
  FIRST_RETRY_MS,
  MOST_RETRY_MS,
  REPLACE_MS,
} from '../../ground/threads/kept-thread.ts';
import type { SinkFault, VelocitySink } from '../../ground/velocity-sink.ts';
import type {
  RosDriveOptions,
  RosDriveReport,
  RosDriveRequest,
  RosDriveSetup,
} from './ros-drive-messages.ts';
import { REPEAT_MS, TAIL_MS } from './ros-velocity.ts';
import { SinkBeat } from './sink-beat.ts';
import { wheelsReading } from './wheels-reading.ts';

const THREAD = new URL('./ros-drive-worker.ts', import.meta.url);
/**
 * The thread beats every 10 ms. When 25 of them are missing, it counts as hung, ms. Chosen: collections of
 * garbage and a busy computer stay below; the thread's own watchdog has stopped the wheels before.
 */
const HUNG_MS = 250;
/**
 * A thread that has lived this long was well: the next wait is short again, ms. As long as the longest wait.
 */
const WELL_MS = MOST_RETRY_MS;
/** After a thread ended in motion, its successor publishes zero this many times: for a second. */
const OWED_ZEROS = TAIL_MS / REPEAT_MS;
/**
 * How long after motion zeros may not have been published: a thread that hangs takes some time to end.
 * Chosen: above the second after which a thread that hangs is replaced and the second that it has to end.
 */
const OWED_FOR_MS = 5000;

/**
 * Publishes velocities to a ROS graph from its own thread. A thread that ends or hangs is replaced; meanwhile, and while
 * nobody subscribes, {@link fault} says so.
 */
export class RosSink implements VelocitySink {
  readonly kind: string;
  /** How often a thread was replaced. */
  restarts = 0;
  readonly #options: RosDriveOptions;
  readonly #log: Logger;
  readonly #thread: URL;
  readonly #checking: NodeJS.Timeout;
  readonly #backoff = new Backoff({ firstMs: FIRST_RETRY_MS, mostMs: MOST_RETRY_MS, random: Math.random });
  #worker: Worker | null = null;
  #beat = new SinkBeat();
  #startedMs = 0;
  #ended: Promise<unknown> = Promise.resolve();
  #retry: NodeJS.Timeout | null = null;
  /** `null` until the thread says. */
  #listeners: number | null = null;
  #told: SinkFault | null | undefined;
  #onReading: ((reading: TopicReading) => void) | null = null;
  #reading: TopicReading | null = null;
  #movedMs = Number.NEGATIVE_INFINITY;
  #owedZeros = 0;
  #closing = false;

  /** @param thread the program of the thread; another one in tests */
  constructor(options: RosDriveOptions, log: Logger, thread = THREAD) {
    const { topic, type } = options.entry;
    this.#options = options;
    this.#log = log;
    this.#thread = thread;
    this.kind = `${options.graph.kind} (${topic}, ${type})`;
    this.#start();
    this.#checking = setInterval(() => this.#check(), CHECK_MS);
  }

  get fault(): SinkFault | null {
    if (this.#worker === null) return 'thread-ended';
    const silentMs = this.#beat.silentMs(monotonicMs());
    if (silentMs === null || this.#listeners === null) return 'starting';
    if (silentMs > HUNG_MS) return 'thread-hung';
    return this.#listeners === 0 ? 'no-listener' : null;
  }

  /** Reports whether any node subscribes, and whether velocities can be published. */
  tellReadings(listener: (reading: TopicReading) => void): void {
    this.#onReading = listener;
    if (this.#reading !== null) listener(this.#reading);
  }

  apply(twist: Twist, estop: boolean): void {
    if (this.#worker === null) return;
    const owes = this.#owedZeros > 0 && this.#listeners !== null;
    if (owes) this.#owedZeros--;
    if (!isZeroTwist(twist)) this.#movedMs = monotonicMs();
    this.#post({ type: 'twist', twist, hold: estop || owes });
  }

  /** Resolves when the last zero has been handed to the graph. */
  async close(): Promise<void> {
    this.#closing = true;
    clearInterval(this.#checking);
    if (this.#retry !== null) clearTimeout(this.#retry);
    this.#post({ type: 'close' });
    const worker = this.#worker;
    // A thread that hangs does not end when it is asked to.
    const late = setTimeout(() => void worker?.terminate(), CLOSE_MS);
    await this.#ended;
    clearTimeout(late);
  }

  #start(): void {
    this.#retry = null;
    this.#beat = new SinkBeat();
    this.#listeners = null;
    this.#startedMs = monotonicMs();
    const workerData: RosDriveSetup = { ...this.#options, beat: this.#beat.memory };
    const worker = new Worker(this.#thread, { name: 'drive', workerData });
    this.#worker = worker;
    worker.on('message', (report: RosDriveReport) => this.#onReport(report));
    worker.on('error', (error) =>
      this.#log.error(
        { detail: error instanceof Error ? error.message : String(error) },
        'velocities cannot be published',
      ),
    );
    this.#ended = new Promise((resolve) => worker.once('exit', resolve));
    worker.once('exit', () => this.#onExit());
    this.#check();
  }

  #onReport(report: RosDriveReport): void {
    const { topic } = this.#options.entry;
    if (report.type === 'listeners') {
      this.#listeners = report.count;
      this.#log.info({ topic, listeners: report.count }, 'who listens to velocities');
      this.#told = undefined;
      this.#check();
    } else if (report.type === 'failed') {
      this.#log.error({ detail: report.detail }, 'velocities cannot be published');
    } else {
      this.#log.warn({ detail: report.detail }, 'the ROS graph has a fault');
    }
  }

  #onExit(): void {
    this.#worker = null;
    if (this.#closing) return;
    if (monotonicMs() - this.#movedMs < OWED_FOR_MS) this.#owedZeros = OWED_ZEROS;
    if (monotonicMs() - this.#startedMs > WELL_MS) this.#backoff.reset();
    const inMs = this.#backoff.nextMs();
    this.#log.error(
      { inMs: Math.round(inMs) },
      'the thread that publishes velocities has ended: starting another',
    );
    this.#check();
    this.restarts++;
    this.#retry = setTimeout(() => this.#start(), inMs);
  }

  /** Replaces a thread that hangs, and tells what has changed. */
  #check(): void {
    const { fault } = this;
    if (fault === 'thread-hung' && (this.#beat.silentMs(monotonicMs()) ?? 0) > REPLACE_MS) {
      void this.#worker?.terminate();
    }
    if (fault === this.#told) return;
    this.#told = fault;
    this.#reading = wheelsReading(this.#options.entry.topic, fault, `${this.#listeners} listening`);
    this.#onReading?.(this.#reading);
  }

  #post(request: RosDriveRequest): void {
    this.#worker?.postMessage(request);
  }
}
