/** How dark the edge of the view is while the view is moved by something else than the operator's own body. Pure. */
import type { HeadsetSettings } from '../../ground/headset-settings.ts';

/**
 * From these on, it is as dark as it is set to become: turning, rad/s, and moving, m/s. Chosen: three
 * quarters of the steady turn (operator-turn.ts), and faster than most robots here. vignette-amount.test.ts
 * holds the speed and the times.
 */
const FULL_TURN = Math.PI / 4;
const FULL_SPEED = 2;
/**
 * Time constants, ms: it comes fast and goes gently. Chosen: it must be there before the motion is felt, and
 * its end must not be seen.
 */
const COMES_MS = 60;
const GOES_MS = 300;
/** Less than this is not drawn. */
const LEAST = 0.01;

export class VignetteAmount {
  /** 0 (not drawn) … 1. */
  value = 0;
  readonly #settings: Pick<HeadsetSettings, 'vignette'>;

  /** @param settings are read at each call */
  constructor(settings: Pick<HeadsetSettings, 'vignette'>) {
    this.#settings = settings;
  }

  clear(): void {
    this.value = 0;
  }

  /**
   * @param turnRate of the view, rad/s
   * @param speed of the view, m/s
   * @param elapsedMs time since the last call
   */
  update(turnRate: number, speed: number, elapsedMs: number): void {
    const motion = Math.max(Math.abs(turnRate) / FULL_TURN, Math.abs(speed) / FULL_SPEED);
    const wanted = Number.isFinite(motion) ? this.#settings.vignette * Math.min(motion, 1) : 0;
    const tau = wanted > this.value ? COMES_MS : GOES_MS;
    this.value += (wanted - this.value) * (1 - Math.exp(-Math.max(elapsedMs, 0) / tau));
    if (this.value < LEAST && wanted < LEAST) this.value = 0;
  }
}
