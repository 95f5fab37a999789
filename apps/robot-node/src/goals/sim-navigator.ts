import type { Twist } from '@farpoint/protocol';
import type { Goal } from '@farpoint/safety';
import { steerTo } from '@farpoint/sim';
import type { FloorPlace, Navigator } from './navigator.ts';

/** Slow enough for a robot that knows nothing of what is in the way, m/s and rad/s. */
const LIMITS = { maxLinear: 0.5, maxAngular: 0.8 };

/** The simulated robot's own navigator. */
export class SimNavigator implements Navigator {
  onVelocity: ((twist: Twist, atMs: number) => void) | null = null;

  begin(): void {}
  end(): void {}

  update(goal: Readonly<Goal>, pose: Readonly<FloorPlace>, nowMs: number): void {
    this.onVelocity?.(steerTo(goal, pose, LIMITS), nowMs);
  }

  async close(): Promise<void> {}
}
