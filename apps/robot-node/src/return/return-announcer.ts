import { Worker } from 'node:worker_threads';
import type { Logger } from '@farpoint/service';
import { Backoff } from '@farpoint/timing';
import type { AnnounceReport, AnnounceRequest, AnnounceSetup } from './announce-worker.ts';
import type { ReturnConfiguration } from './return-configuration.ts';

const THREAD = new URL('./announce-worker.ts', import.meta.url);
const FIRST_RETRY_MS = 250;
const MOST_RETRY_MS = 10_000;
/** The time that the thread has to leave the graph, ms. */
const CLOSE_MS = 1000;

/** Says on a topic of the robot's ROS graph, std_msgs/Bool, whether the robot drives back by itself. */
export class ReturnAnnouncer {
  readonly #topic: NonNullable<ReturnConfiguration['topic']>;
  readonly #log: Pick<Logger, 'warn'>;
  readonly #backoff = new Backoff({ firstMs: FIRST_RETRY_MS, mostMs: MOST_RETRY_MS, random: Math.random });
  #isActive = false;
  #worker: Worker | null = null;
  #ended: Promise<unknown> = Promise.resolve();
  #retry: NodeJS.Timeout | null = null;
  #closing = false;

  constructor(topic: NonNullable<ReturnConfiguration['topic']>, log: Pick<Logger, 'warn'>) {
    this.#topic = topic;
    this.#log = log;
    this.#start();
  }

  say(isActive: boolean): void {
    if (isActive === this.#isActive) return;
    this.#isActive = isActive;
    this.#post({ type: 'active', isActive });
  }

  async close(): Promise<void> {
    this.#closing = true;
    if (this.#retry !== null) clearTimeout(this.#retry);
    this.#post({ type: 'close' });
    const worker = this.#worker;
    const late = setTimeout(() => void worker?.terminate(), CLOSE_MS);
    await this.#ended;
    clearTimeout(late);
  }

  #start(): void {
    const workerData: AnnounceSetup = { ...this.#topic, isActive: this.#isActive };
    const worker = new Worker(THREAD, { name: 'return topic', workerData });
    this.#worker = worker;
    worker.on('message', ({ fault }: AnnounceReport) => this.#warn(fault));
    worker.on('error', (error: unknown) =>
      this.#warn(error instanceof Error ? error.message : String(error)),
    );
    this.#ended = new Promise((resolve) => worker.once('exit', resolve));
    worker.once('exit', () => {
      this.#worker = null;
      if (!this.#closing) this.#retry = setTimeout(() => this.#start(), this.#backoff.nextMs());
    });
  }

  #warn(detail: string): void {
    this.#log.warn({ topic: this.#topic.topic, detail }, 'the return topic has a fault');
  }

  #post(request: AnnounceRequest): void {
    this.#worker?.postMessage(request);
  }
}
