import { wearEmulatedHeadset } from '@farpoint/local-stack';
import type { Page } from '@playwright/test';
import type { Grip } from './operator-page.ts';

/** Without a GPU, two large eyes take longer to draw than a grip may go unread. */
export const headsetViewport = { width: 480, height: 270 };

export type Hand = 'left' | 'right';

/** A Meta Quest 3 emulated in the page. Put it on before the page loads. */
export class Headset {
  readonly #page: Page;
  readonly #step: ((frames: number) => Promise<void>) | null;

  private constructor(page: Page, step: ((frames: number) => Promise<void>) | null) {
    this.#page = page;
    this.#step = step;
  }

  /** @param step draws display frames, where the test does so itself */
  static async wear(page: Page, step: ((frames: number) => Promise<void>) | null = null): Promise<Headset> {
    await wearEmulatedHeadset(page);
    return new Headset(page, step);
  }

  /** @param x right @param y back (as in WebXR: pushing forward is −1) */
  async thumbstick(hand: Hand, x: number, y: number): Promise<void> {
    await this.#page.evaluate(
      ([hand, x, y]) => window.emulatedHeadset.controllers[hand]?.updateAxes('thumbstick', x, y),
      [hand, x, y] as const,
    );
  }

  /** Points a hand down, straight ahead. @param down radians below level */
  async tilt(hand: Hand, down: number): Promise<void> {
    await this.#page.evaluate(
      ([hand, down]) => {
        const { controllers, hands } = window.emulatedHeadset;
        for (const each of [controllers[hand], hands[hand]])
          each?.quaternion.set(-Math.sin(down / 2), 0, 0, Math.cos(down / 2));
      },
      [hand, down] as const,
    );
  }

  /** @param at right, up, back, metres; the eyes are at a height of 1.6 m */
  async place(hand: Hand, at: [x: number, y: number, z: number]): Promise<void> {
    await this.#page.evaluate(([hand, at]) => window.emulatedHeadset.controllers[hand]?.position.set(...at), [
      hand,
      at,
    ] as const);
  }

  /**
   * Moves the head.
   *
   * @param at right, up, back, metres; it begins at [0, 1.6, 0]
   * @param yaw radians to the left
   */
  async head(at: [x: number, y: number, z: number], yaw = 0): Promise<void> {
    await this.#page.evaluate(
      ([at, yaw]) => {
        window.emulatedHeadset.position.set(...at);
        window.emulatedHeadset.quaternion.set(0, Math.sin(yaw / 2), 0, Math.cos(yaw / 2));
      },
      [at, yaw] as const,
    );
  }

  /** Sets what the browser keeps about the headset. Call it before the page loads. */
  async settings(headset: Record<string, string | number>): Promise<void> {
    await this.#page.addInitScript((headset) => {
      // A page that has been reloaded keeps what it was told since.
      if (localStorage.getItem('farpoint.settings') === null)
        localStorage.setItem('farpoint.settings', JSON.stringify({ headset }));
    }, headset);
  }

  /** Presses a button, and lets it go. */
  async press(hand: Hand, id: string): Promise<void> {
    await this.button(hand, id, 1);
    await this.frames(3);
    await this.button(hand, id, 0);
    await this.frames(3);
  }

  /** Puts the controllers down, so that the headset tracks bare hands; or takes them up again. */
  async bareHands(bare: boolean): Promise<void> {
    await this.#page.evaluate(
      (mode) => {
        window.emulatedHeadset.primaryInputMode = mode;
      },
      bare ? ('hand' as const) : ('controller' as const),
    );
    await this.frames(3);
  }

  /** @param at right, up, back, metres @param pinches 0 open … 1 */
  async bareHand(hand: Hand, at: [x: number, y: number, z: number], pinches: number): Promise<void> {
    await this.#page.evaluate(
      ([hand, at, pinches]) => {
        const bare = window.emulatedHeadset.hands[hand];
        bare?.position.set(...at);
        bare?.updatePinchValue(pinches);
      },
      [hand, at, pinches] as const,
    );
    await this.frames(3);
  }

  /** Waits for display frames. */
  async frames(count: number): Promise<void> {
    if (this.#step !== null) return this.#step(count);
    await this.#page.evaluate(
      (count) =>
        new Promise<void>((resolve) => {
          const next = (left: number) => {
            if (left === 0) resolve();
            else requestAnimationFrame(() => next(left - 1));
          };
          next(count);
        }),
      count,
    );
  }

  /** Takes the headset off, or puts it on again: the runtime then hides the session from the page. */
  async worn(worn: boolean): Promise<void> {
    await this.#page.evaluate(
      (state) => window.emulatedHeadset.updateVisibilityState(state),
      worn ? ('visible' as const) : ('hidden' as const),
    );
  }

  /** The squeeze button of a hand. */
  grip(hand: Hand): Grip {
    return {
      hold: () => this.button(hand, 'squeeze', 1),
      release: () => this.button(hand, 'squeeze', 0),
    };
  }

  /** @param value 0 released … 1 held */
  async button(hand: Hand, id: string, value: number): Promise<void> {
    await this.#page.evaluate(
      ([hand, id, value]) => window.emulatedHeadset.controllers[hand]?.updateButtonValue(id, value),
      [hand, id, value] as const,
    );
  }
}
