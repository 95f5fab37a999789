/** A gamepad, a wheel or a joystick. It drives while its grip is held, as its map says. */
import type { DriveInput, DriveWish, PressedButtons } from '@farpoint/operator';
import {
  type AxisMap,
  deflection,
  GRIP_SHARES,
  isAtRest,
  mustRestFirst,
  shapedDeflection,
} from './axis-map.ts';
import { type ButtonRole, type ControllerMap, STANDARD_MAP, type StickMap } from './controller-map.ts';

/** The fields of a Gamepad that are read. */
export interface GamepadState {
  readonly axes: readonly (number | null)[];
  readonly buttons: readonly { readonly pressed: boolean; readonly value: number }[];
}

/** The buttons pressed since the last reading, or held. */
export interface PadButtons extends PressedButtons {
  readonly faster: boolean;
  readonly slower: boolean;
}

/** Those that count once for each press. */
const ONCE = ['estop', 'latencyTest', 'nextRobot', 'faster', 'slower'] as const;
type Once = (typeof ONCE)[number];

const NOTHING: GamepadState = { axes: [], buttons: [] };

export class GamepadInput implements DriveInput {
  readonly name = 'gamepad';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  held = false;
  readMs = Number.NEGATIVE_INFINITY;
  #mustOpen = false;
  #map: ControllerMap | null = null;
  /** Whether the pedal that is the grip is pressed. */
  #pedal = false;
  readonly #down = new Set<Once>();
  /** Axes that have been read at their rest since the device came. */
  readonly #rested = new Set<number>();
  readonly #pressed = {
    estop: false,
    latencyTest: false,
    nextRobot: false,
    faster: false,
    slower: false,
    releaseHeld: false,
  };

  /**
   * @param pad the device's current state, or `null` if it is disconnected
   * @param nowMs `performance.now()`
   * @param map what its axes and buttons do; with another one the grip counts as released until it has been opened
   * @returns the buttons that were pressed since the last call, or are held; the same object each time
   */
  read(pad: GamepadState | null, nowMs: number, map: ControllerMap = STANDARD_MAP): PadButtons {
    this.readMs = nowMs;
    if (map !== this.#map) {
      if (this.#map !== null) this.release();
      this.#map = map;
      this.#rested.clear();
    }
    const { axes, buttons } = pad ?? NOTHING;
    this.#readButtons(buttons, map);
    const grips = this.#isGripped(axes, buttons, map);
    if (pad === null) {
      this.#rested.clear();
      // Plugged in again with the grip held, it drives only once that has been opened.
      this.#mustOpen ||= this.held;
    } else this.#mustOpen &&= grips;
    this.held = grips && !this.#mustOpen;
    this.#wishOf(axes, map.sticks);
    return this.#pressed;
  }

  /** The hand counts as open until a reading has found it open. */
  release(): void {
    this.#mustOpen = true;
    this.held = false;
    this.wish.forward = 0;
    this.wish.left = 0;
    this.wish.sideways = undefined;
  }

  #readButtons(buttons: GamepadState['buttons'], map: ControllerMap): void {
    for (const role of ONCE) {
      const isNow = isDown(buttons, map, role);
      this.#pressed[role] = isNow && !this.#down.has(role);
      if (isNow) this.#down.add(role);
      else this.#down.delete(role);
    }
    this.#pressed.releaseHeld = isDown(buttons, map, 'release');
  }

  #isGripped(axes: GamepadState['axes'], buttons: GamepadState['buttons'], map: ControllerMap): boolean {
    const { gripAxis } = map;
    if (gripAxis === null) this.#pedal = false;
    else {
      const share = this.#counts(axes, gripAxis) ? deflection(axes[gripAxis.axis], gripAxis) : 0;
      this.#pedal = share > (this.#pedal ? GRIP_SHARES.open : GRIP_SHARES.held);
    }
    // A trigger is a grip once it is pulled half of its way.
    for (const index of map.buttons.grip) if ((buttons[index]?.value ?? 0) > 0.5) return true;
    return this.#pedal;
  }

  /** The stick that is deflected the most drives; sideways goes what is deflected the most for that. */
  #wishOf(axes: GamepadState['axes'], sticks: readonly StickMap[]): void {
    const { wish } = this;
    let most = -1;
    let slide = 0;
    for (const { forward, back, left, sideways } of sticks) {
      const aslant = this.#axis(axes, sideways ?? null);
      if (Math.abs(aslant) > Math.abs(slide)) slide = aslant;
      const ahead = this.#axis(axes, forward) - Math.max(this.#axis(axes, back), 0);
      const aside = this.#axis(axes, left);
      const far = Math.hypot(ahead, aside);
      if (far <= most) continue;
      most = far;
      // + 0 turns −0 into 0.
      wish.forward = ahead + 0;
      wish.left = aside + 0;
    }
    wish.sideways = slide || undefined;
  }

  #axis(axes: GamepadState['axes'], map: AxisMap | null): number {
    return map !== null && this.#counts(axes, map) ? shapedDeflection(axes[map.axis], map) : 0;
  }

  /** Whether what the axis reads is known to be a deflection. */
  #counts(axes: GamepadState['axes'], map: AxisMap): boolean {
    if (!mustRestFirst(map) || this.#rested.has(map.axis)) return true;
    if (isAtRest(axes[map.axis], map)) this.#rested.add(map.axis);
    return false;
  }
}

function isDown(buttons: GamepadState['buttons'], map: ControllerMap, role: ButtonRole): boolean {
  for (const index of map.buttons[role]) if (buttons[index]?.pressed === true) return true;
  return false;
}
