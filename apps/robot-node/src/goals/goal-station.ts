/** The robot's goals: asks the navigator to lead to them, feeds the guided drive, and tells everybody what becomes of them. */
import type { DriveLimits, GoalPhase, GoalReason } from '@farpoint/protocol';
import { defaultGuidedOptions, type Goal, GuidedDrive } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import type { TimedBaseState } from '../base/base.ts';
import { measuredPose } from '../return/measured-pose.ts';
import { ReasonCounts } from '../telemetry/robot-counters.ts';
import type { GoalConfiguration } from './goal-configuration.ts';
import type { Navigator } from './navigator.ts';

export interface GoalStationParts {
  /** Of the robot. */
  limits: Pick<DriveLimits, 'maxLinear' | 'maxAngular' | 'watchdogMs'>;
  navigator: Navigator;
  /** Whether the base is simulated: then its state was measured at its time. */
  isSimulated: boolean;
  log: Pick<Logger, 'info' | 'warn'>;
}

export class GoalStation {
  /** Moves the robot, under the drive guard. */
  readonly guided: GuidedDrive;
  /** Goals that the robot has taken. */
  taken = 0;
  /** Goals that were refused, by reason. */
  readonly refused = new ReasonCounts();
  /** Ends of goals that were taken: `reached`, or the reason. */
  readonly ends = new ReasonCounts();
  /** Velocities of the navigator that could not be followed. */
  invalid = 0;
  /** Called at each change of what becomes of a goal. */
  onState: ((goal: Readonly<Goal>, state: GoalPhase, reason: GoalReason | null) => void) | null = null;
  /** Called when the robot may have to move in another way. */
  onVelocity: (() => void) | null = null;
  readonly #parts: GoalStationParts;

  constructor({ mostM, navigatorSilentMs }: GoalConfiguration, parts: GoalStationParts) {
    this.#parts = parts;
    const { maxLinear, maxAngular, watchdogMs } = parts.limits;
    this.guided = new GuidedDrive({
      ...{ ...defaultGuidedOptions, mostM, navigatorSilentMs, maxLinear, maxAngular, watchdogMs },
    });
    this.guided.onState = (goal, state, reason) => this.#tell(goal, state, reason);
    parts.navigator.onVelocity = (twist, atMs) => {
      if (this.guided.goal === null) return;
      if (!this.guided.navigate(twist, atMs)) this.invalid++;
      this.onVelocity?.();
    };
  }

  /** Call this every 25 ms. @param state the newest of the base; `null` before the first */
  update(state: TimedBaseState | null, nowMs: number): void {
    const { guided } = this;
    const measured = state === null ? null : measuredPose(state, this.#parts.isSimulated);
    if (measured !== null) guided.moved(measured.pose, measured.measuredMs);
    const { goal, pose } = guided;
    if (goal !== null && pose !== null) this.#parts.navigator.update(goal, pose, nowMs);
  }

  close(): Promise<void> {
    return this.#parts.navigator.close();
  }

  #tell(goal: Readonly<Goal>, state: GoalPhase, reason: GoalReason | null): void {
    const { navigator, log } = this.#parts;
    const { pose } = this.guided;
    if (state === 'accepted') {
      this.taken++;
      if (pose !== null) navigator.begin(goal, pose);
      log.info({ x: goal.x, y: goal.y, yaw: goal.yaw }, 'drives to a goal');
    } else if (state !== 'driving') {
      this.ends.add(reason ?? state);
      // A navigator that has reached its goal has done; the next goal replaces this one by itself.
      if (state !== 'reached' && reason !== 'replaced') navigator.end(pose);
      log.info({ state, ...(reason === null ? {} : { reason }) }, 'does not drive to the goal any more');
    }
    this.onState?.(goal, state, reason);
  }
}
