/**
 * The emergency stop. Every press of stop latches it, whatever its state. Only holding the separate release control
 * releases it.
 */

import type { RobotClient, StopStatus } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { Notices } from '../../state/notices.ts';
import type { PageState } from '../../state/page-state.ts';
import type { ReleaseControl, ReleaseHold } from '../../take/drive/release-hold.ts';
import type { LatchedStop } from '../../words/estop-words.ts';
import { texts } from '../../words/language.ts';
import { stopWords } from '../../words/words.ts';
import { elements } from './elements.ts';

export class EstopUi {
  readonly #client: RobotClient;
  readonly #robot: PageState['robot'];
  readonly #link: PageState['link'];
  readonly #notices: Pick<Notices, 'tell'>;
  readonly #stopNews: PageState['stopNews'];
  readonly #hold: ReleaseHold;

  constructor(client: RobotClient, { robot, link, notices, stopNews }: PageState, hold: ReleaseHold) {
    this.#client = client;
    this.#robot = robot;
    this.#link = link;
    this.#notices = notices;
    this.#stopNews = stopNews;
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
    const { latchedStop, estopAtRobot } = this.#robot;
    // A STOP that is pressed between two sessions is kept for the next.
    effect(() => {
      elements.stop.hidden = !this.#link.connected.value;
    });
    effect(() => showLatched(latchedStop.value, estopAtRobot.value));
    effect(() => showWhere(estopAtRobot.value));
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

  /**
   * Releases the stop once its control was held long enough.
   *
   * @param away the operator cannot see the page or is not at its controls
   */
  update(nowMs: number, away: boolean): void {
    if (away) this.#hold.letGo();
    const mayRelease = this.#robot.latchedStop.peek()?.mayRelease === true;
    if (!this.#hold.advance(nowMs, mayRelease)) return;
    this.#stopNews.onOwnRelease();
    this.#client.releaseEstop();
  }
}

/** @param stop `null` while it is not latched */
function showLatched(stop: LatchedStop | null, atRobot: boolean): void {
  const { estop, estopRelease, latency, stopBand, stopTitle, stopWhy, stopHow } = elements;
  const latched = stop !== null;
  estop.setAttribute('aria-pressed', String(latched));
  estop.querySelector('span')!.textContent = texts().stop.button[latched ? 'latched' : 'clear'];
  // A stop at the robot keeps the control, which then says where it is released.
  estopRelease.hidden = !latched || !(stop.mayRelease || atRobot);
  stopBand.hidden = !latched;
  stopBand.dataset.stale = String(stop?.heard === false);
  stopTitle.textContent = latched ? texts().stop.title : '';
  stopWhy.textContent = stop?.why ?? '';
  stopHow.textContent = stop?.release ?? '';
  // The release control needs its place, and a robot that cannot drive has nothing to measure.
  latency.hidden = latched;
}

/** A stop at the robot itself is released there, by nobody here. */
function showWhere(atRobot: boolean): void {
  const { estopRelease } = elements;
  estopRelease.disabled = atRobot;
  const { releaseAtRobot, holdToRelease } = texts().page;
  estopRelease.querySelector('b')!.textContent = atRobot ? releaseAtRobot : holdToRelease;
  for (const words of estopRelease.querySelectorAll<HTMLElement>(':scope > span'))
    words.hidden = words.classList.contains('at-robot') !== atRobot;
}

/** Also without a session: then it is kept until the link returns. */
function showStop(status: StopStatus): void {
  const words = stopWords(status);
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
