/**
 * The emergency stop. Every press of stop latches it, whatever its state. Only holding the separate release control
 * releases it.
 */

import type { RobotClient, StopStatus } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { RobotState } from '../../state/robot-state.ts';
import type { ReleaseControl, ReleaseHold } from '../../take/drive/release-hold.ts';
import { stopWords } from '../../words/words.ts';
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
    // Act on the press: a finger that slides off the button, or a second finger, produces no click.
    estop.addEventListener('pointerdown', () => this.stop());
    estop.addEventListener('click', () => this.stop());
    estopRelease.addEventListener('pointerdown', ({ button }) => this.hold('pointer', button === 0));
    for (const end of ['pointerup', 'pointercancel', 'pointerleave', 'lostpointercapture'] as const) {
      estopRelease.addEventListener(end, () => this.hold('pointer', false));
    }
    // Neither button keeps the focus after a press, so that the space bar remains the drive grip.
    for (const control of [estop, estopRelease]) {
      control.addEventListener('mousedown', (event) => event.preventDefault());
    }
    // A long touch must not open a menu.
    estopRelease.addEventListener('contextmenu', (event) => event.preventDefault());
    effect(() => showStop(this.#robot.stop.value));
    effect(() => showLatched(this.#robot.estopLatched.value));
    effect(() => showWhere(this.#robot.estopAtRobot.value));
    effect(() => showProgress(this.#hold.progress.value));
  }

  stop(): void {
    this.#hold.cancel();
    this.#client.estop();
  }

  hold(control: ReleaseControl, down: boolean): void {
    this.#hold.set(control, down);
  }

  /**
   * Releases the stop once its control was held long enough.
   *
   * @param away the operator cannot see the page or is not at its controls
   */
  update(nowMs: number, away: boolean): void {
    if (away) this.#hold.letGo();
    const { estopLatched, estopAtRobot } = this.#robot;
    const mayRelease = estopLatched.value && !estopAtRobot.value;
    if (this.#hold.advance(nowMs, mayRelease)) this.#client.releaseEstop();
  }
}

function showLatched(latched: boolean): void {
  const { estop, estopRelease, latency } = elements;
  estop.setAttribute('aria-pressed', String(latched));
  estop.querySelector('span')!.textContent = latched ? 'engaged' : 'emergency';
  estopRelease.hidden = !latched;
  // The release control needs its place, and a robot that cannot drive has nothing to measure.
  latency.hidden = latched;
}

/** A stop at the robot itself is released there, by nobody here. */
function showWhere(atRobot: boolean): void {
  const { estopRelease } = elements;
  estopRelease.disabled = atRobot;
  estopRelease.querySelector('b')!.textContent = atRobot ? 'Release at robot' : 'Hold to release';
  for (const words of estopRelease.querySelectorAll<HTMLElement>(':scope > span'))
    words.hidden = words.classList.contains('at-robot') !== atRobot;
}

/** Also without a session: then it is kept until the link returns. */
function showStop(status: StopStatus): void {
  const words = stopWords[status];
  const { stopState } = elements;
  stopState.hidden = words === null;
  stopState.textContent = words?.text ?? '';
  stopState.dataset.tone = words?.tone ?? 'neutral';
}

function showProgress(progress: number): void {
  const share = progress.toFixed(2);
  elements.estopRelease.style.setProperty('--held', share);
  elements.estopRelease.classList.toggle('held', share !== '0.00');
}
