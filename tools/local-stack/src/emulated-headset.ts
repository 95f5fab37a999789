import { createRequire } from 'node:module';

const RUNTIME = createRequire(import.meta.url).resolve('iwer/build/iwer.min.js');

/** The parts of the emulated headset (iwer's XRDevice) that tests and benchmarks use. */
export interface EmulatedHeadset {
  stereoEnabled: boolean;
  updateVisibilityState(state: 'visible' | 'visible-blurred' | 'hidden'): void;
  position: { set(x: number, y: number, z: number): void };
  quaternion: { set(x: number, y: number, z: number, w: number): void };
  controllers: Record<'left' | 'right', EmulatedController | undefined>;
  hands: Record<'left' | 'right', EmulatedHand | undefined>;
  primaryInputMode: 'controller' | 'hand';
  installRuntime(options: { forceInstall: boolean }): void;
}

export interface EmulatedController {
  /** @param x right @param y back (as in WebXR: pushing forward is −1) */
  updateAxes(id: string, x: number, y: number): void;
  /** @param value 0 released … 1 held */
  updateButtonValue(id: string, value: number): void;
  inputSource: {
    gamepad?: { hapticActuators: { pulse(strength: number, ms: number): Promise<boolean> }[] };
  };
  position: { set(x: number, y: number, z: number): void };
  quaternion: { set(x: number, y: number, z: number, w: number): void };
}

export interface EmulatedHand {
  /** @param value 0 open … 1 pinched */
  updatePinchValue(value: number): void;
  position: { set(x: number, y: number, z: number): void };
  quaternion: { set(x: number, y: number, z: number, w: number): void };
}

declare global {
  /** In a page that {@link wearEmulatedHeadset} prepared. */
  var emulatedHeadset: EmulatedHeadset;
  var IWER: { XRDevice: new (config: unknown) => EmulatedHeadset; metaQuest3: unknown };
}

/** What it needs of Playwright's page. */
interface ScriptedPage {
  addInitScript(script: { path: string } | (() => void)): Promise<unknown>;
}

/** Emulates a Meta Quest 3 in the page, seen with both eyes. Call it before the page loads. */
export async function wearEmulatedHeadset(page: ScriptedPage): Promise<void> {
  await page.addInitScript({ path: RUNTIME });
  await page.addInitScript(() => {
    globalThis.emulatedHeadset = new globalThis.IWER.XRDevice(globalThis.IWER.metaQuest3);
    globalThis.emulatedHeadset.stereoEnabled = true;
    globalThis.emulatedHeadset.installRuntime({ forceInstall: true });
  });
}
