import { Worker } from 'node:worker_threads';
import type { TimedBaseState } from '@farpoint/cloud-source';
import type { Twist } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import { officeWorld } from '@farpoint/sim';
import type { VelocitySink } from '../../ground/velocity-sink.ts';
import type { BaseOptions, BaseReport, BaseRequest, BaseWorkerData } from './base-messages.ts';
import { makeSharedSnapshot } from './shared-snapshot.ts';

/**
 * The main thread's end of the simulated base. It takes velocities and returns the base's state. Sensors share its
 * world.
 */
export class BaseThread implements VelocitySink {
  readonly kind = 'simulated base';
  /** Simulated sensors read the world from here. */
  readonly snapshot = makeSharedSnapshot(officeWorld().movers.length);
  onState: ((state: TimedBaseState) => void) | null = null;
  /** Called with what the topics say, and the numbers of the motors' topic. */
  onReadings: ((readings: readonly TopicReading[], motors: readonly (number | null)[]) => void) | null = null;
  /** Called once if the thread ends unexpectedly. */
  onFailure: ((error: Error) => void) | null = null;
  watchdogStops = 0;
  /** Simulated sensors see these, too. */
  readonly things: BaseOptions['things'];
  readonly #worker: Worker;
  readonly #ended: Promise<unknown>;
  #closing = false;

  constructor(options: BaseOptions) {
    this.things = options.things;
    const workerData: BaseWorkerData = { ...options, snapshot: this.snapshot };
    this.#worker = new Worker(new URL('./base-worker.ts', import.meta.url), { name: 'base', workerData });
    this.#worker.on('message', ({ state, watchdogStops, readings, motors = [] }: BaseReport) => {
      this.watchdogStops = watchdogStops;
      this.onState?.(state);
      if (readings !== undefined) this.onReadings?.(readings, motors);
    });
    this.#worker.on('error', (error) => this.#fail(error instanceof Error ? error.message : String(error)));
    this.#ended = new Promise((resolve) => this.#worker.once('exit', resolve));
    void this.#ended.then((code) => this.#fail(`exit code ${code}`));
  }

  apply(twist: Twist): void {
    this.#post({ type: 'twist', twist });
  }

  async close(): Promise<void> {
    if (!this.#closing) {
      this.#closing = true;
      this.#post({ type: 'close' });
    }
    await this.#ended;
  }

  #post(request: BaseRequest): void {
    this.#worker.postMessage(request);
  }

  #fail(detail: string): void {
    if (this.#closing) return;
    this.#closing = true;
    this.onFailure?.(new Error(`the simulated base’s thread ended: ${detail}`));
  }
}
