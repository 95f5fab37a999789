/** The emergency stop: any press of stop latches it, whatever its state; only the other control, held, releases it. */
import { type ReleaseControl, ReleaseHold } from '../drive/release-hold.ts';
import type { PageParts } from '../page-parts.ts';
import { elements } from './elements.ts';

export class EstopUi {
  readonly #app: Pick<PageParts, 'link' | 'driver'>;
  readonly #hold = new ReleaseHold();
  #shown = '';

  constructor(app: Pick<PageParts, 'link' | 'driver'>) {
    this.#app = app;
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
    const { link } = this.#app;
    if (link.phase === 'live') link.sendSession({ type: 'estop', latch: true });
  }

  hold(control: ReleaseControl, down: boolean): void {
    this.#hold.set(control, down);
  }

  /** @param away no hand can be seen */
  tick(nowMs: number, away: boolean): void {
    const { link, driver } = this.#app;
    const latched = link.phase === 'live' && link.session.estop.latched;
    if (away) this.#hold.letGo();
    if (this.#hold.tick(nowMs, latched)) {
      // Who drives releases; where nobody does, whoever holds this is about to.
      if (driver.holder === 'nobody') driver.requestLease(false);
      link.sendSession({ type: 'estop', latch: false });
    }
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
