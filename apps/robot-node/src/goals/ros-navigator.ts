import { type Twist, zeroTwist } from '@farpoint/protocol';
import type { Goal } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import { KeptThread } from '../threads/kept-thread.ts';
import type { RosNavigatorOptions } from './goal-configuration.ts';
import type { GoalWorkerReport, GoalWorkerRequest } from './goal-messages.ts';
import type { FloorPlace, Navigator } from './navigator.ts';

const PROGRAM = new URL('./goal-worker.ts', import.meta.url);
const MOST_RETRY_MS = 10_000;

/**
 * A navigator in the robot's ROS graph: Nav2 or move_base. It hears goals as RViz gives them, and cannot be told to give
 * one up by a topic: its velocities are no longer passed on instead, and its goal becomes the place where the robot is.
 */
export class RosNavigator implements Navigator {
  onVelocity: ((twist: Twist, atMs: number) => void) | null = null;
  /** Messages on the velocities' topic that are none. */
  malformed = 0;
  readonly #options: RosNavigatorOptions;
  readonly #log: Pick<Logger, 'warn'>;
  readonly #thread: KeptThread<GoalWorkerReport>;

  constructor(options: RosNavigatorOptions, log: Pick<Logger, 'warn'>) {
    this.#options = options;
    this.#log = log;
    const closeMessage: GoalWorkerRequest = { type: 'close' };
    this.#thread = new KeptThread<GoalWorkerReport>({
      ...{ program: PROGRAM, name: 'goals', mostRetryMs: MOST_RETRY_MS, closeMessage },
      data: () => this.#options,
      onReport: (report) => this.#take(report),
      onError: (detail) => this.#warn(detail),
    });
    this.#thread.start();
  }

  begin({ x, y, yaw }: Readonly<Goal>, pose: Readonly<FloorPlace>): void {
    // A goal needs a direction: as the robot will come, where the operator asks for none.
    this.#send({ x, y, yaw: yaw ?? Math.atan2(y - pose.y, x - pose.x) });
  }

  end(pose: Readonly<FloorPlace> | null): void {
    if (pose !== null) this.#send({ x: pose.x, y: pose.y, yaw: pose.yaw });
  }

  update(): void {}

  close(): Promise<void> {
    return this.#thread.close();
  }

  #send(goal: FloorPlace): void {
    const request: GoalWorkerRequest = { type: 'goal', goal };
    this.#thread.post(request);
  }

  #take(report: GoalWorkerReport): void {
    if (report.type === 'fault') {
      this.#warn(report.detail);
      return;
    }
    this.#thread.isWell();
    if (report.twist === null) this.malformed++;
    this.onVelocity?.(report.twist ?? zeroTwist(), report.receivedMs);
  }

  #warn(detail: string): void {
    const { goalTopic, velocityTopic } = this.#options;
    this.#log.warn({ goalTopic, velocityTopic, detail }, 'the navigator’s topics have a fault');
  }
}
