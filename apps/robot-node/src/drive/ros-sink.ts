import { Worker } from 'node:worker_threads';
import type { Twist } from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import type { RosDriveOptions, RosDriveReport, RosDriveRequest } from './ros-drive-messages.ts';
import type { VelocitySink } from './velocity-sink.ts';

/** Publishes velocities to a ROS graph, from a thread of its own. */
export class RosSink implements VelocitySink {
  readonly kind: string;
  readonly #worker: Worker;
  readonly #ended: Promise<unknown>;
  #alive = true;

  constructor(options: RosDriveOptions, log: Logger) {
    const { topic, type } = options.entry;
    this.kind = `${options.graph.kind} (${topic}, ${type})`;
    this.#worker = new Worker(new URL('./ros-drive-worker.ts', import.meta.url), { workerData: options });
    this.#worker.on('message', ({ type, detail }: RosDriveReport) => {
      if (type === 'failed') log.error({ detail }, 'velocities cannot be published');
      else log.warn({ detail }, 'the ROS graph has a fault');
    });
    this.#worker.on('error', (error) => log.error({ err: error }, 'velocities are not published any more'));
    this.#ended = new Promise((resolve) => this.#worker.once('exit', resolve));
    void this.#ended.then(() => {
      this.#alive = false;
    });
  }

  apply(twist: Twist, estop: boolean): void {
    this.#post({ type: 'twist', twist, hold: estop });
  }

  /** Ends when the last zero has been handed to the graph. */
  async close(): Promise<void> {
    this.#post({ type: 'close' });
    await this.#ended;
  }

  #post(request: RosDriveRequest): void {
    if (this.#alive) this.#worker.postMessage(request);
  }
}
