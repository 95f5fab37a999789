import { Worker } from 'node:worker_threads';
import type { ReadingLevel, Twist } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import type { Logger } from '@farpoint/service';
import type { RosDriveOptions, RosDriveReport, RosDriveRequest } from './ros-drive-messages.ts';
import type { VelocitySink } from './velocity-sink.ts';

/** Publishes velocities to a ROS graph from its own thread. */
export class RosSink implements VelocitySink {
  readonly kind: string;
  readonly #worker: Worker;
  readonly #ended: Promise<unknown>;
  readonly #topic: string;
  #onReading: ((reading: TopicReading) => void) | null = null;
  #reading: TopicReading | null = null;
  #alive = true;

  constructor(options: RosDriveOptions, log: Logger) {
    const { topic, type } = options.entry;
    this.#topic = topic;
    this.kind = `${options.graph.kind} (${topic}, ${type})`;
    this.#worker = new Worker(new URL('./ros-drive-worker.ts', import.meta.url), { workerData: options });
    this.#worker.on('message', (report: RosDriveReport) => {
      if (report.type === 'listeners') {
        const { count } = report;
        log.info({ topic, listeners: count }, 'who listens to velocities');
        this.#tell(count === 0 ? 'warn' : 'ok', count === 0 ? 'nobody listens' : `${count} listening`);
      } else if (report.type === 'failed') {
        this.#fail(report.detail, log);
      } else {
        log.warn({ detail: report.detail }, 'the ROS graph has a fault');
      }
    });
    this.#worker.on('error', (error) =>
      this.#fail(error instanceof Error ? error.message : String(error), log),
    );
    this.#ended = new Promise((resolve) => this.#worker.once('exit', resolve));
    void this.#ended.then(() => {
      this.#alive = false;
    });
  }

  /** Reports whether any node subscribes. */
  tellReadings(listener: (reading: TopicReading) => void): void {
    this.#onReading = listener;
    if (this.#reading !== null) listener(this.#reading);
  }

  apply(twist: Twist, estop: boolean): void {
    this.#post({ type: 'twist', twist, hold: estop });
  }

  /** Resolves when the last zero has been handed to the graph. */
  async close(): Promise<void> {
    this.#post({ type: 'close' });
    await this.#ended;
  }

  #fail(detail: string, log: Logger): void {
    log.error({ detail }, 'velocities cannot be published');
    this.#tell('error', 'velocities cannot be published');
  }

  #tell(level: ReadingLevel, text: string): void {
    this.#reading = { topic: this.#topic, label: 'Wheels', level, values: [['', `${this.#topic}: ${text}`]] };
    this.#onReading?.(this.#reading);
  }

  #post(request: RosDriveRequest): void {
    if (this.#alive) this.#worker.postMessage(request);
  }
}
