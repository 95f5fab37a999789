/** Finds out which axis or button a hand moves, and how far the axes go. Pure. */
import { type AxisMap, DEAD_ZONES, LEAST_RANGE, type Reading } from './axis-map.ts';
import type { ControllerMap, StickMap } from './controller-map.ts';
import type { GamepadState } from './gamepad-input.ts';

type Axes = GamepadState['axes'];

/**
 * An axis counts as moved when it has been this far from its rest, and as back when it is this near again. Chosen: a hand that
 * meant one axis moves the others less; controller-learning.test.ts holds them.
 */
const MOVED = 0.5;
const BACK = LEAST_RANGE;

/** Waits for one axis to be moved all the way and let go. */
export class MovedAxis {
  readonly #rest: readonly number[];
  /** The farthest from its rest that each axis has been. */
  readonly #far: number[];

  /** @param rest the axes while nobody touches them */
  constructor(rest: Axes) {
    this.#rest = rest.map(finite);
    this.#far = this.#rest.map(() => 0);
  }

  /** @returns the axis that was moved and let go, positive the way it was moved; `null` until there is one */
  see(axes: Axes): AxisMap | null {
    let moved: number | null = null;
    for (const [axis, rest] of this.#rest.entries()) {
      const off = finite(axes[axis]) - rest;
      if (Math.abs(off) > Math.abs(this.#far[axis] ?? 0)) this.#far[axis] = off;
      const far = Math.abs(this.#far[axis] ?? 0);
      if (Math.abs(off) > BACK) continue;
      if (far > MOVED && far > Math.abs(moved === null ? 0 : (this.#far[moved] ?? 0))) moved = axis;
    }
    if (moved === null) return null;
    const inverted = (this.#far[moved] ?? 0) < 0;
    const centre = clamped(this.#rest[moved]);
    return { axis: moved, centre, least: -1, most: 1, inverted, deadZone: DEAD_ZONES.usual };
  }
}

/** Waits for a button to be pressed. */
export class PressedButton {
  readonly #down: Set<number>;

  /** @param buttons as they are before the press */
  constructor(buttons: GamepadState['buttons']) {
    this.#down = new Set(downOf(buttons));
  }

  /** @returns the button that is pressed and was not; `null` until there is one */
  see(buttons: GamepadState['buttons']): number | null {
    const now = downOf(buttons);
    const pressed = now.find((index) => !this.#down.has(index));
    // One that was down at first can be pressed, too, once it has been let go.
    for (const index of [...this.#down]) if (!now.includes(index)) this.#down.delete(index);
    return pressed ?? null;
  }
}

/** Measures where the axes rest and how far they go. */
export class Calibration {
  readonly #centre: readonly number[];
  readonly #least: number[];
  readonly #most: number[];

  /** @param rest the axes while nobody touches them */
  constructor(rest: Axes) {
    this.#centre = rest.map(clamped);
    this.#least = [...this.#centre];
    this.#most = [...this.#centre];
  }

  /** Call this often while every axis is moved all the way. */
  see(axes: Axes): void {
    for (const axis of this.#centre.keys()) {
      const value = clamped(axes[axis]);
      this.#least[axis] = Math.min(this.#least[axis] ?? value, value);
      this.#most[axis] = Math.max(this.#most[axis] ?? value, value);
    }
  }

  /** @returns `map` with what was measured. An axis that did not move keeps its range; it is in `still`. */
  finish(map: ControllerMap): { map: ControllerMap; still: readonly number[] } {
    const still = new Set<number>();
    const measured = (was: AxisMap | null): AxisMap | null => {
      if (was === null) return null;
      const { axis } = was;
      const [centre, least, most] = [this.#centre[axis], this.#least[axis], this.#most[axis]];
      if (centre === undefined || least === undefined || most === undefined) return was;
      if (most - least < 2 * LEAST_RANGE) {
        still.add(axis);
        return was;
      }
      return { ...was, centre, least, most };
    };
    const sticks = map.sticks.map(
      ({ forward, back, left, sideways }): StickMap => ({
        forward: measured(forward),
        back: measured(back),
        left: measured(left),
        ...(sideways == null ? {} : { sideways: measured(sideways) }),
      }),
    );
    const gripAxis = measured(map.gripAxis);
    return { map: { ...map, sticks, gripAxis }, still: [...still].sort((a, b) => a - b) };
  }
}

function downOf(buttons: GamepadState['buttons']): number[] {
  return buttons.flatMap(({ pressed, value }, index) => (pressed === true || value > 0.5 ? [index] : []));
}

function clamped(value: Reading): number {
  return Math.min(Math.max(finite(value), -1), 1);
}

function finite(value: Reading): number {
  return typeof value === 'number' && Number.isFinite(value) ? value : 0;
}
