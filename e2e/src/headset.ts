import { createRequire } from 'node:module';
import type { Page } from '@playwright/test';
import type { OperatorPage } from './operator-page.ts';

const require = createRequire(import.meta.url);

/** The parts of the emulated headset (iwer's XRDevice) that the tests use. */
interface EmulatedDevice {
  stereoEnabled: boolean;
  position: { set(x: number, y: number, z: number): void };
  controllers: Record<
    'left' | 'right',
    | {
        updateAxes(id: string, x: number, y: number): void;
        updateButtonValue(id: string, value: number): void;
        position: { set(x: number, y: number, z: number): void };
      }
    | undefined
  >;
  installRuntime(options: { forceInstall: boolean }): void;
}

declare global {
  interface Window {
    IWER: { XRDevice: new (config: unknown) => EmulatedDevice; metaQuest3: unknown };
    emulatedHeadset: EmulatedDevice;
  }
}

export type Hand = 'left' | 'right';

/** A Meta Quest 3 emulated in the page. Put it on before the page loads. */
export class Headset {
  readonly #page: Page;

  private constructor(page: Page) {
    this.#page = page;
  }

  static async wear(page: Page): Promise<Headset> {
    await page.addInitScript({ path: require.resolve('iwer/build/iwer.min.js') });
    await page.addInitScript(() => {
      window.emulatedHeadset = new window.IWER.XRDevice(window.IWER.metaQuest3);
      window.emulatedHeadset.stereoEnabled = true;
      window.emulatedHeadset.installRuntime({ forceInstall: true });
    });
    return new Headset(page);
  }

  /** @param x right @param y back (as in WebXR: pushing forward is −1) */
  async thumbstick(hand: Hand, x: number, y: number): Promise<void> {
    await this.#page.evaluate(
      ([hand, x, y]) => window.emulatedHeadset.controllers[hand]?.updateAxes('thumbstick', x, y),
      [hand, x, y] as const,
    );
  }

  /** @param at right, up, back, metres; the eyes are at a height of 1.6 m */
  async place(hand: Hand, at: [x: number, y: number, z: number]): Promise<void> {
    await this.#page.evaluate(([hand, at]) => window.emulatedHeadset.controllers[hand]?.position.set(...at), [
      hand,
      at,
    ] as const);
  }

  /** The right hand, which holds the grip: it grips anew where the robot waits for that, as the keys do. */
  gripOf(operator: OperatorPage): Pick<OperatorPage, 'gripAnew'> {
    return {
      gripAnew: async () => {
        if ((await operator.state()).drive !== 'watchdog') return;
        await this.button('right', 'squeeze', 0);
        await operator.expectState('drive', 'idle');
        await this.button('right', 'squeeze', 1);
      },
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
