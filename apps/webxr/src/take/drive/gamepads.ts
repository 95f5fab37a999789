/** All gamepads, wheels and joysticks that the browser shows: reads each by its own map. */
import { type ControllerMap, missingOf } from './controller-map.ts';
import { GamepadInput, type GamepadState, type PadButtons } from './gamepad-input.ts';
import { controllerKey } from './input-choices.ts';
import type { InputSettings } from './input-settings.ts';

/** The fields of a Gamepad that are read. */
export interface ConnectedPad extends GamepadState {
  readonly id?: string | undefined;
  readonly mapping?: string | undefined;
  readonly connected?: boolean | undefined;
}

export interface GamepadEvents {
  /** A device is there that does not drive before somebody has set it up: once for each, while the page is open. */
  onUnknown(id: string | undefined): void;
  /** A device that could drive is gone. */
  onUnplugged(id: string | undefined): void;
}

/** How many devices are read. Chosen: twice as many as Chromium shows; gamepads.test.ts holds it. */
const SLOTS = 8;

/** A device's place in the browser's list. */
class Slot {
  readonly input = new GamepadInput();
  /** Which device is there; `null`: none. */
  key: string | null = null;
  id: string | undefined;
  mapping: string | undefined;
}

export class Gamepads {
  /** Whether devices are being set up: they drive nothing then, and press nothing but STOP. */
  settingUp = false;
  readonly #slots = Array.from({ length: SLOTS }, () => new Slot());
  readonly #settings: Pick<InputSettings, 'mapOf'>;
  readonly #events: GamepadEvents;
  /** Devices that people have been told of. */
  readonly #told = new Set<string>();
  readonly #pressed = {
    estop: false,
    latencyTest: false,
    nextRobot: false,
    faster: false,
    slower: false,
    releaseHeld: false,
  };

  constructor(settings: Pick<InputSettings, 'mapOf'>, events: GamepadEvents) {
    this.#settings = settings;
    this.#events = events;
  }

  get all(): readonly GamepadInput[] {
    return this.#slots.map(({ input }) => input);
  }

  /** All hands count as open until a reading has found them open. */
  release(): void {
    for (const { input } of this.#slots) input.release();
  }

  /**
   * @param pads as `navigator.getGamepads()` gives them
   * @param nowMs `performance.now()`
   * @returns what was pressed on any of them since the last call, or is held; the same object each time
   */
  read(pads: readonly (ConnectedPad | null)[], nowMs: number): PadButtons {
    const all = this.#pressed;
    all.estop = all.latencyTest = all.nextRobot = all.faster = all.slower = all.releaseHeld = false;
    for (const [index, slot] of this.#slots.entries()) {
      const pad = pads[index] ?? null;
      const pressed = this.#readSlot(slot, pad?.connected === false ? null : pad, nowMs);
      all.estop ||= pressed.estop;
      if (this.settingUp) {
        slot.input.release();
        continue;
      }
      all.latencyTest ||= pressed.latencyTest;
      all.nextRobot ||= pressed.nextRobot;
      all.faster ||= pressed.faster;
      all.slower ||= pressed.slower;
      all.releaseHeld ||= pressed.releaseHeld;
    }
    return all;
  }

  #readSlot(slot: Slot, pad: ConnectedPad | null, nowMs: number): PadButtons {
    const { input } = slot;
    if (pad === null) {
      if (slot.key !== null) this.#gone(slot, slot.key);
      return input.read(null, nowMs);
    }
    if (slot.key === null || slot.id !== pad.id || slot.mapping !== pad.mapping) {
      // Another device: whatever the one before it held counts as let go.
      if (slot.key !== null) input.release();
      slot.id = pad.id;
      slot.mapping = pad.mapping;
      slot.key = controllerKey(pad);
    }
    const map = this.#settings.mapOf(slot.key);
    this.#tellUnknown(slot, slot.key, map);
    return input.read(pad, nowMs, map);
  }

  #gone(slot: Slot, key: string): void {
    slot.key = null;
    if (missingOf(this.#settings.mapOf(key)) === null) this.#events.onUnplugged(slot.id);
  }

  #tellUnknown(slot: Slot, key: string, map: ControllerMap): void {
    if (this.settingUp || this.#told.has(key) || missingOf(map) === null) return;
    this.#told.add(key);
    this.#events.onUnknown(slot.id);
  }
}
