import type { ReturnOptions } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import { KeptThread } from '../../ground/threads/kept-thread.ts';
import type { AnnounceReport, AnnounceRequest, AnnounceSetup } from './announce-worker.ts';

/** How the robot drives back by itself, as configured. */
export interface ReturnConfiguration {
  options: ReturnOptions;
  /** Where the robot says that it does; `null`: in no topic. */
  topic: { graph: GraphOptions; topic: string } | null;
}

const PROGRAM = new URL('./announce-worker.ts', import.meta.url);

/** Says on a topic of the robot's ROS graph, std_msgs/Bool, whether the robot drives back by itself. */
export class ReturnAnnouncer {
  readonly #topic: NonNullable<ReturnConfiguration['topic']>;
  readonly #log: Pick<Logger, 'warn'>;
  readonly #thread: KeptThread<AnnounceReport>;
  #isActive = false;

  constructor(topic: NonNullable<ReturnConfiguration['topic']>, log: Pick<Logger, 'warn'>) {
    this.#topic = topic;
    this.#log = log;
    const closeMessage: AnnounceRequest = { type: 'close' };
    this.#thread = new KeptThread<AnnounceReport>({
      program: PROGRAM,
      name: 'return topic',
      closeMessage,
      data: (): AnnounceSetup => ({ ...this.#topic, isActive: this.#isActive }),
      onReport: ({ fault }) => this.#warn(fault),
      onError: (detail) => this.#warn(detail),
    });
    this.#thread.start();
  }

  say(isActive: boolean): void {
    if (isActive === this.#isActive) return;
    this.#isActive = isActive;
    const request: AnnounceRequest = { type: 'active', isActive };
    this.#thread.post(request);
  }

  close(): Promise<void> {
    return this.#thread.close();
  }

  #warn(detail: string): void {
    this.#log.warn({ topic: this.#topic.topic, detail }, 'the return topic has a fault');
  }
}
