/** The emergency stop: any press of stop latches it, whatever its state; only the other control, held, releases it. */

import type { RobotClient } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { ReleaseControl, ReleaseHold } from '../drive/release-hold.ts';
import type { RobotState } from '../state/robot-state.ts';
import { elements } from './elements.ts';

export class EstopUi {
  readonly #client: RobotClient;
  readonly #robot: RobotState;
  readonly #hold: ReleaseHold;

  constructor(client: RobotClient, robot: RobotState, hold: ReleaseHold) {
    this.#client = client;
    this.#robot = robot;
    this.#hold = hold;
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
    effect(() => showLatched(this.#robot.estopLatched.value));
    effect(() => showProgress(this.#hold.progress.value));
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
    if (away) this.#hold.letGo();
    if (this.#hold.tick(nowMs, this.#robot.estopLatched.value)) this.#client.releaseEstop();
  }
}

function showLatched(latched: boolean): void {
  const { estop, estopRelease, latency } = elements;
  estop.setAttribute('aria-pressed', String(latched));
  estop.querySelector('span')!.textContent = latched ? 'latched' : 'emergency';
  estopRelease.hidden = !latched;
  // Its place is needed, and there is nothing to drive for.
  latency.hidden = latched;
}

function showProgress(progress: number): void {
  const share = progress.toFixed(2);
  elements.estopRelease.style.setProperty('--held', share);
  elements.estopRelease.classList.toggle('held', share !== '0.00');
}
