/** The emergency stop: any press of stop latches it, whatever its state; only the other control, held, releases it. */

import type { RobotClient } from '@farpoint/operator';
import { type ReleaseControl, ReleaseHold } from '../drive/release-hold.ts';
import { elements } from './elements.ts';

export class EstopUi {
  readonly #client: RobotClient;
  readonly #hold = new ReleaseHold();
  #shown = '';

  constructor(client: RobotClient) {
    this.#client = client;
  }

  start(): void {
    const { estop, estopRelease } = elements;
    // At the press: a finger that slides off, or the second of two, makes no click.
    estop.addEventListener('pointerdown', () => this.stop());
    estop.addEventListener('click', () => this.stop());
    estopRelease.addEventListener('pointerdown', ({ button }) => this.hold('pointer', button === 0));
    for (const end of ['pointerup', 'pointercancel', 'pointerleave', 'lostpointercapture'] as const) {
      estopRelease.addEventListener(end, () => this.hold('pointer', false));
    }
    // Neither keeps the focus of a press: the space bar is the grip again.
    for (const control of [estop, estopRelease]) {
      control.addEventListener('mousedown', (event) => event.preventDefault());
    }
    // A long touch is no wish for a menu.
    estopRelease.addEventListener('contextmenu', (event) => event.preventDefault());
  }

  /** How far the hold has come, 0–1. */
  get progress(): number {
    return this.#hold.progress;
  }

  stop(): void {
    this.#hold.cancel();
    this.#client.estop();
  }

  hold(control: ReleaseControl, down: boolean): void {
    this.#hold.set(control, down);
  }

  /** @param away no hand can be seen */
  tick(nowMs: number, away: boolean): void {
    const { link } = this.#client;
    const latched = link.phase === 'live' && link.session.estop.latched;
    if (away) this.#hold.letGo();
    if (this.#hold.tick(nowMs, latched)) this.#client.releaseEstop();
    this.#show(latched);
  }

  #show(latched: boolean): void {
    const share = this.progress.toFixed(2);
    const key = `${latched} ${share}`;
    if (key === this.#shown) return;
    this.#shown = key;
    const { estop, estopRelease, latency } = elements;
    estop.setAttribute('aria-pressed', String(latched));
    estop.querySelector('span')!.textContent = latched ? 'latched' : 'emergency';
    estopRelease.hidden = !latched;
    // Its place is needed, and there is nothing to drive for.
    latency.hidden = latched;
    estopRelease.style.setProperty('--held', share);
    estopRelease.classList.toggle('held', share !== '0.00');
  }
}
