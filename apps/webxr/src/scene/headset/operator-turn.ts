/** Turning the operator's view by a stick: in steps, or steadily. Pure. */

import type { HeadsetSettings } from '../../ground/headset-settings.ts';
import { DEFAULT_STICK_RESPONSE, shapeAxis } from '../../take/drive/dead-zone.ts';

/**
 * A step is taken at this deflection, and the next one only after the stick has come back to the second.
 * Chosen: a push that is meant, and a gap that a trembling thumb does not cross.
 */
const STEP_AT = 0.7;
const ARMED_BELOW = 0.4;
/**
 * Steady turning at full deflection, rad/s (docs/headset.md). Chosen: faster turning of the view makes more
 * people sick.
 */
export const STEADY_RATE = Math.PI / 3;
/**
 * The most that one frame may turn for, ms: after a hang the view must not spin. Chosen: 3° at the full rate;
 * operator-turn.test.ts holds it.
 */
const MOST_FRAME_MS = 50;

export class OperatorTurn {
  readonly #settings: Pick<HeadsetSettings, 'turn' | 'snapDegrees'>;
  /** A stick that is already deflected when a session begins turns nothing. */
  #armed = false;

  /** @param settings are read at each call */
  constructor(settings: Pick<HeadsetSettings, 'turn' | 'snapDegrees'>) {
    this.#settings = settings;
  }

  /** Nothing turns before the stick has been centred. */
  disarm(): void {
    this.#armed = false;
  }

  /**
   * @param stick deflection to the right, −1…1
   * @param elapsedMs time since the last call
   * @returns by how much the view turns now, radians, positive to the left
   */
  by(stick: number, elapsedMs: number): number {
    const { turn, snapDegrees } = this.#settings;
    const deflection = Math.abs(stick);
    if (!(deflection > ARMED_BELOW)) {
      this.#armed = true;
      if (turn !== 'smooth') return 0;
    }
    if (!this.#armed) return 0;
    if (turn === 'smooth') {
      const seconds = Math.min(Math.max(elapsedMs, 0), MOST_FRAME_MS) / 1000;
      return -shapeAxis(stick, DEFAULT_STICK_RESPONSE) * STEADY_RATE * seconds + 0;
    }
    if (turn !== 'snap' || deflection < STEP_AT) return 0;
    this.#armed = false;
    const step = (snapDegrees * Math.PI) / 180;
    return stick > 0 ? -step : step;
  }
}
