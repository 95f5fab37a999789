import type { Base, BaseState } from '@farpoint/cloud-source';
import type { Twist } from '@farpoint/protocol';
import type { SimulatedBase } from '@farpoint/sim';

/**
 * The most that the simulated robot catches up after a stall, s. Chosen: longer ones would move it far in one
 * step, through what stands there.
 */
const MAX_STEP_S = 0.25;

/** The simulator's base, in real time. */
export class RealTimeBase implements Base {
  readonly simulated: SimulatedBase;
  #lastMs: number | null = null;

  constructor(simulated: SimulatedBase) {
    this.simulated = simulated;
  }

  advance(nowMs: number, twist: Twist): void {
    const seconds = this.#lastMs === null ? 0 : (nowMs - this.#lastMs) / 1000;
    this.#lastMs = nowMs;
    this.simulated.setCommand(twist);
    this.simulated.step(Math.min(Math.max(seconds, 0), MAX_STEP_S));
  }

  get state(): BaseState {
    const { pose, twist, battery, collision } = this.simulated.state;
    const { voltage, percentage } = battery;
    return { pose, twist, battery: { voltage, percentage }, contact: collision };
  }
}
