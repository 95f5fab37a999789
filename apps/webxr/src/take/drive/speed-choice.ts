/** How fast the operator wants to drive at most. It scales wishes down; the robot's own limits stay what they are. */
import type { DriveInput, DriveWish } from '@farpoint/operator';
import { type Signal, signal } from '@preact/signals-core';

/** Shares of the robot's greatest speed. Chosen: four, so that a gear is known without looking; speed-choice.test.ts holds them. */
export const GEARS = [0.25, 0.5, 0.75, 1] as const;
/** Chosen: with less, a stick that is pushed all the way seems to do nothing; speed-choice.test.ts holds it. */
export const SPEED_SHARES = { least: 0.1, most: 1 } as const;

/** @returns a share that may be used, whatever `value` is: the whole speed if it is none */
export function usableShare(value: unknown): number {
  if (typeof value !== 'number' || !Number.isFinite(value)) return SPEED_SHARES.most;
  return Math.min(Math.max(value, SPEED_SHARES.least), SPEED_SHARES.most);
}

export class SpeedChoice {
  /** Share of the robot's greatest speed, 0.1…1. */
  readonly share: Signal<number>;

  constructor(share: unknown) {
    this.share = signal(usableShare(share));
  }

  set(share: number): void {
    this.share.value = usableShare(share);
  }

  /** The next gear up; the highest stays. */
  faster(): void {
    this.set(GEARS.find((gear) => gear > this.share.peek()) ?? SPEED_SHARES.most);
  }

  /** The next gear down; the lowest stays, and so does what is slower. */
  slower(): void {
    const now = this.share.peek();
    this.set(GEARS.findLast((gear) => gear < now) ?? Math.min(now, GEARS[0]));
  }

  /** The next gear up; after the highest the lowest. */
  cycle(): void {
    if (this.share.peek() >= SPEED_SHARES.most) this.set(GEARS[0]);
    else this.faster();
  }
}

/** A device whose wishes are scaled by the choice. Its grip is the device's own. */
export class ScaledInput implements DriveInput {
  readonly #device: DriveInput;
  readonly #choice: SpeedChoice;
  readonly #wish: DriveWish = { forward: 0, left: 0 };

  constructor(device: DriveInput, choice: SpeedChoice) {
    this.#device = device;
    this.#choice = choice;
  }

  get name(): DriveInput['name'] {
    return this.#device.name;
  }

  get held(): boolean {
    return this.#device.held;
  }

  get pushed(): boolean {
    const { pushed, wish } = this.#device;
    return pushed ?? (wish.forward !== 0 || wish.left !== 0);
  }

  get readMs(): number | null {
    return this.#device.readMs;
  }

  get wish(): Readonly<DriveWish> {
    const share = usableShare(this.#choice.share.peek());
    this.#wish.forward = scaled(this.#device.wish.forward, share);
    this.#wish.left = scaled(this.#device.wish.left, share);
    const { sideways } = this.#device.wish;
    this.#wish.sideways = sideways === undefined ? undefined : scaled(sideways, share);
    return this.#wish;
  }
}

function scaled(wish: number, share: number): number {
  return Number.isFinite(wish) ? Math.min(Math.max(wish, -1), 1) * share + 0 : 0;
}
