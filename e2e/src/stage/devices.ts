/** Gamepads, wheels and joysticks in a test's hands: what `navigator.getGamepads` returns. */
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

export class Devices {
  readonly #page: Page;

  private constructor(page: Page) {
    this.#page = page;
  }

  /** Call this before the page is loaded. */
  static async install(page: Page): Promise<Devices> {
    await page.addInitScript(() => {
      window.testPads = [];
      navigator.getGamepads = () => window.testPads as never;
    });
    return new Devices(page);
  }

  /** @param mapping `standard`, or nothing for one whose axes and buttons are not named @param held buttons that are held */
  async plugIn(
    id: string,
    mapping: 'standard' | '',
    axes: readonly number[],
    held: readonly number[] = [],
  ): Promise<void> {
    await this.#page.evaluate(
      ([id, mapping, axes, held]) => {
        const buttons = Array.from({ length: 17 }, (_, button) => {
          const pressed = held.includes(button);
          return { pressed, touched: pressed, value: Number(pressed) };
        });
        window.testPads[0] = { id, mapping, connected: true, axes: [...axes], buttons };
      },
      [id, mapping, axes, held] as const,
    );
  }

  async unplug(): Promise<void> {
    await this.#page.evaluate(() => {
      window.testPads[0] = null;
    });
  }

  async press(button: number, pressed: boolean): Promise<void> {
    await this.#page.evaluate(
      ([button, pressed]) => {
        Object.assign(window.testPads[0]!.buttons[button]!, { pressed, value: Number(pressed) });
      },
      [button, pressed] as const,
    );
  }

  async move(axis: number, value: number): Promise<void> {
    await this.#page.evaluate(
      ([axis, value]) => {
        window.testPads[0]!.axes[axis] = value;
      },
      [axis, value] as const,
    );
  }
}
