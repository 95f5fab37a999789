/** A gamepad, a wheel or a joystick. It drives while its grip is held, as its map says. */

import type { DriveInput, DriveWish, PressedButtons } from '@farpoint/operator';
import { type AxisMap, isAtRest, mustRestFirst, shapedDeflection } from './axis-map.ts';
import { type ButtonRole, type ControllerMap, STANDARD_MAP, type StickMap } from './controller-map.ts';

/** The fields of a Gamepad that are read. */
export interface GamepadState {
  axes: readonly (number | null)[];
  buttons: readonly { pressed: boolean; value: number }[];
}

/** The buttons pressed since the last reading, or held. */
export interface PadButtons extends PressedButtons {
  readonly faster: boolean;
  readonly slower: boolean;
}

/** Those that count once per press. */
const ONCE = ['estop', 'latencyTest', 'nextRobot', 'faster', 'slower'] as const;

export class GamepadInput implements DriveInput {
  readonly name = 'gamepad';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  held = false;
  readMs = Number.NEGATIVE_INFINITY;
  #mustOpen = false;
  #map: ControllerMap | null = null;
  readonly #down = new Set<ButtonRole>();
  /** Axes that have been read at their rest since the controller came. */
  readonly #rested = new Set<number>();

  /**
   * @param pad the controller's current state, or `null` if it is disconnected
   * @param nowMs `performance.now()`
   * @param map what its axes and buttons do; with another one the grip counts as open until it has been opened
   */
  read(pad: GamepadState | null, nowMs: number, map: ControllerMap = STANDARD_MAP): PadButtons {
    this.readMs = nowMs;
    if (map !== this.#map) {
      if (this.#map !== null) this.release();
      this.#map = map;
      this.#rested.clear();
    }
    if (pad === null) {
      this.#rested.clear();
      // Plugged in again, it drives only once it has been opened.
      if (this.held) this.#mustOpen = true;
    }
    const down = (role: ButtonRole) =>
      map.buttons[role].some((index) => pad?.buttons[index]?.pressed === true);
    const pressed = {
      ...this.#pressedOnce(down),
      releaseHeld: down('release'),
    };
    // A trigger is a grip once it is pulled half of its way.
    const grips = map.buttons.grip.some((index) => (pad?.buttons[index]?.value ?? 0) > 0.5);
    if (pad !== null) this.#mustOpen &&= grips;
    this.held = grips && !this.#mustOpen;
    this.#wishOf(pad?.axes ?? [], map.sticks);
    return pressed;
  }

  /** The hand counts as open until a reading has found it open. */
  release(): void {
    this.#mustOpen = true;
    this.held = false;
    this.wish.forward = 0;
    this.wish.left = 0;
  }

  #pressedOnce(down: (role: ButtonRole) => boolean): Record<(typeof ONCE)[number], boolean> {
    const pressed = { estop: false, latencyTest: false, nextRobot: false, faster: false, slower: false };
    for (const role of ONCE) {
      const isNow = down(role);
      pressed[role] = isNow && !this.#down.has(role);
      if (isNow) this.#down.add(role);
      else this.#down.delete(role);
    }
    return pressed;
  }

  /** The stick that is deflected the most drives. */
  #wishOf(axes: GamepadState['axes'], sticks: readonly StickMap[]): void {
    const { wish } = this;
    let most = -1;
    for (const { forward, back, left } of sticks) {
      const ahead = this.#axis(axes, forward) - Math.max(this.#axis(axes, back), 0);
      const aside = this.#axis(axes, left);
      const far = Math.hypot(ahead, aside);
      if (far <= most) continue;
      most = far;
      // + 0 turns −0 into 0.
      wish.forward = ahead + 0;
      wish.left = aside + 0;
    }
  }

  #axis(axes: GamepadState['axes'], map: AxisMap | null): number {
    if (map === null) return 0;
    const value = axes[map.axis];
    if (mustRestFirst(map) && !this.#rested.has(map.axis)) {
      if (isAtRest(value, map)) this.#rested.add(map.axis);
      return 0;
    }
    return shapedDeflection(value, map);
  }
}
