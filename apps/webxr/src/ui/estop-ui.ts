/**
 * The emergency stop. Every press of stop latches it, whatever its state. Only holding the separate release control
 * releases it.
 */

import type { RobotClient, StopStatus } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { ReleaseControl, ReleaseHold } from '../drive/release-hold.ts';
import type { PageState } from '../state/page-state.ts';
import type { RobotState } from '../state/robot-state.ts';
import { LATCHED_TITLE, type LatchedStop, stopButtonWords } from '../status/estop-words.ts';
import { eventWords } from '../status/event-words.ts';
import { stopWords } from '../status/words.ts';
import { elements } from './elements.ts';

export class EstopUi {
  readonly #client: RobotClient;
  readonly #robot: RobotState;
  readonly #hold: ReleaseHold;
  readonly #notices: PageState['notices'];
  readonly #events: PageState['events'];

  constructor(client: RobotClient, { robot, notices, events }: PageState, hold: ReleaseHold) {
    this.#client = client;
    this.#robot = robot;
    this.#hold = hold;
    this.#notices = notices;
    this.#events = events;
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
    const { latchedStop, estopAtRobot } = this.#robot;
    effect(() => showLatched(latchedStop.value, estopAtRobot.value));
    effect(() => showWhere(estopAtRobot.value));
    followHeight(elements.stopBand);
    effect(() => showProgress(this.#hold.progress.value));
  }

  stop(): void {
    this.#hold.cancel();
    this.#client.estop();
  }

  hold(control: ReleaseControl, down: boolean): void {
    if (!this.#hold.set(control, down)) return;
    const stop = this.#robot.latchedStop.peek();
    if (stop !== null && !stop.mayRelease) this.#notices.tell(stop.release, 'warning');
  }

  /** @param away the operator cannot see the page or is not at its controls */
  tick(nowMs: number, away: boolean): void {
    if (away) this.#hold.letGo();
    const mayRelease = this.#robot.latchedStop.peek()?.mayRelease === true;
    if (!this.#hold.tick(nowMs, mayRelease)) return;
    this.#client.releaseEstop();
    this.#events.mark(eventWords.releaseAsked, this.#robot.name.peek());
  }
}

function showLatched(stop: LatchedStop | null, atRobot: boolean): void {
  const { estop, estopRelease, latency, stopBand, stopTitle, stopWhy, stopHow } = elements;
  const latched = stop !== null;
  estop.setAttribute('aria-pressed', String(latched));
  estop.querySelector('span')!.textContent = stopButtonWords[latched ? 'latched' : 'clear'];
  // A stop at the robot keeps the control, which then says where it is released.
  estopRelease.hidden = !latched || !(stop.mayRelease || atRobot);
  // The release control needs its place, and a robot that cannot drive has nothing to measure.
  latency.hidden = latched;
  stopBand.hidden = !latched;
  stopTitle.textContent = latched ? LATCHED_TITLE : '';
  stopWhy.textContent = stop?.why ?? '';
  stopHow.textContent = stop?.release ?? '';
}

/** What is below the band makes room for it. */
function followHeight(band: HTMLElement): void {
  const observer = new ResizeObserver(() => {
    document.documentElement.style.setProperty('--stop-band', `${band.offsetHeight}px`);
  });
  observer.observe(band);
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
