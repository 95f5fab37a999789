import { Worker } from 'node:worker_threads';
import { Backoff } from '@farpoint/timing';
import { monotonicMs } from '../clock.ts';

/**
 * The wait before a thread that ended is started again, ms: it doubles up to the most. Chosen: a single fault
 * is over in a quarter of a second; a lasting one costs the processor a start in 10 s, and the log a line.
 */
export const FIRST_RETRY_MS = 250;
export const MOST_RETRY_MS = 10_000;
/**
 * A thread of the ROS graph that hangs for longer is replaced, ms. Chosen: motion is refused or bounded long before; to
 * replace a thread that is only slow would cost the graph's discovery, seconds.
 */
export const REPLACE_MS = 1000;
/** How often hanging is looked for, ms: a tenth of it. */
export const CHECK_MS = REPLACE_MS / 10;
/**
 * The time that a thread has to end by itself, ms. Chosen: its last messages leave within milliseconds, and
 * service managers wait longer for the program.
 */
export const CLOSE_MS = 1000;

export interface KeptThreadOptions<Report> {
  program: URL;
  /** At most 15 characters are shown by Linux. */
  name: string;
  /** The longest wait before another one is started, ms; default: {@link MOST_RETRY_MS}. */
  mostRetryMs?: number;
  /** One that has lived so long was well, ms; default: only {@link KeptThread.isWell} says so. */
  wellAfterMs?: number;
  /** What it is told to end by itself. */
  closeMessage: unknown;
  /** Makes what the next thread is given. */
  data(): unknown;
  onReport(report: Report): void;
  /** It failed, and ends. @param detail why */
  onError(detail: string): void;
  /** It has ended, and was not asked to; another one is started in `inMs`. */
  onEnd?(inMs: number): void;
}

/** A worker thread in whose place another one is started when it ends, at once at first and then ever more rarely. */
export class KeptThread<Report> {
  /** How often another one was started. */
  restarts = 0;
  readonly #options: KeptThreadOptions<Report>;
  readonly #backoff: Backoff;
  #worker: Worker | null = null;
  #ended: Promise<unknown> = Promise.resolve();
  #retry: NodeJS.Timeout | null = null;
  #closing = false;
  #startedMs = 0;

  constructor(options: KeptThreadOptions<Report>) {
    this.#options = options;
    const { mostRetryMs: mostMs = MOST_RETRY_MS } = options;
    this.#backoff = new Backoff({ firstMs: FIRST_RETRY_MS, mostMs, random: Math.random });
  }

  start(): void {
    const { program, name, data, onReport, onError } = this.#options;
    this.#retry = null;
    this.#startedMs = monotonicMs();
    const worker = new Worker(program, { name, workerData: data() });
    this.#worker = worker;
    worker.on('message', (report: Report) => onReport(report));
    worker.on('error', (error: unknown) => onError(error instanceof Error ? error.message : String(error)));
    this.#ended = new Promise((resolve) => worker.once('exit', resolve));
    worker.once('exit', () => this.#onExit());
  }

  /** It works: if it ends, the next one is started soon. */
  isWell(): void {
    this.#backoff.reset();
  }

  /** Nobody hears it between two threads. */
  post(message: unknown): void {
    this.#worker?.postMessage(message);
  }

  /** Ends it by force, in order to replace it. */
  terminate(): void {
    void this.#worker?.terminate();
  }

  /** Ends it for good; by force if it does not do so by itself within a second. */
  async close(): Promise<void> {
    this.#closing = true;
    if (this.#retry !== null) clearTimeout(this.#retry);
    this.post(this.#options.closeMessage);
    const late = setTimeout(() => this.terminate(), CLOSE_MS);
    await this.#ended;
    clearTimeout(late);
  }

  #onExit(): void {
    this.#worker = null;
    if (this.#closing) return;
    const { wellAfterMs = Number.POSITIVE_INFINITY } = this.#options;
    if (monotonicMs() - this.#startedMs > wellAfterMs) this.isWell();
    const inMs = this.#backoff.nextMs();
    this.restarts++;
    this.#options.onEnd?.(inMs);
    this.#retry = setTimeout(() => this.start(), inMs);
  }
}
