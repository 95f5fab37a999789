/** Controllers in a test's hands: what `navigator.getGamepads` returns. */
import type { Page } from '@playwright/test';

interface Pad {
  id: string;
  mapping: string;
  connected: boolean;
  axes: number[];
  buttons: { pressed: boolean; touched: boolean; value: number }[];
}

declare global {
  interface Window {
    testPads: (Pad | null)[];
  }
}

const FIRST_SLOT = 0;

export class Controllers {
  readonly #page: Page;

  private constructor(page: Page) {
    this.#page = page;
  }

  /** Call this before the page is loaded. */
  static async install(page: Page): Promise<Controllers> {
    await page.addInitScript(() => {
      window.testPads = [];
      navigator.getGamepads = () => window.testPads as never;
    });
    return new Controllers(page);
  }

  /**
   * @param mapping `standard`, or nothing for one whose axes and buttons are not named
   * @param held buttons that are held while it is plugged in
   */
  async plugIn(
    id: string,
    mapping: 'standard' | '',
    axes: readonly number[],
    held: readonly number[] = [],
  ): Promise<void> {
    await this.#page.evaluate(
      ([id, mapping, axes, held, slot]) => {
        const buttons = Array.from({ length: 17 }, (_, button) => {
          const pressed = held.includes(button);
          return { pressed, touched: pressed, value: Number(pressed) };
        });
        const gamepad = { id, mapping, connected: true, axes: [...axes], buttons };
        window.testPads[slot] = gamepad;
        window.dispatchEvent(Object.assign(new Event('gamepadconnected'), { gamepad }));
      },
      [id, mapping, axes, held, FIRST_SLOT] as const,
    );
  }

  async unplug(slot = 0): Promise<void> {
    await this.#page.evaluate((slot) => {
      const gamepad = window.testPads[slot];
      window.testPads[slot] = null;
      window.dispatchEvent(Object.assign(new Event('gamepaddisconnected'), { gamepad }));
    }, slot);
  }

  async press(button: number, pressed: boolean, slot = 0): Promise<void> {
    await this.#page.evaluate(
      ([button, pressed, slot]) => {
        Object.assign(window.testPads[slot]!.buttons[button]!, { pressed, value: Number(pressed) });
      },
      [button, pressed, slot] as const,
    );
  }

  async move(axis: number, value: number, slot = 0): Promise<void> {
    await this.#page.evaluate(
      ([axis, value, slot]) => {
        window.testPads[slot]!.axes[axis] = value;
      },
      [axis, value, slot] as const,
    );
  }
}
