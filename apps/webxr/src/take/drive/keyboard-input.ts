/** The keys that drive, while the grip is held. Pure: the caller passes in the codes of the keys. */
import type { DriveInput, DriveWish } from '@farpoint/operator';
import { EventReading } from './event-reading.ts';
import { DEFAULT_KEYS, type KeyMap, SIDEWAYS_ROLES } from './key-map.ts';

const WAYS = ['forward', 'back', 'left', 'right'] as const;
type Way = (typeof WAYS)[number] | (typeof SIDEWAYS_ROLES)[number];

export class KeyboardInput implements DriveInput {
  readonly name = 'keyboard';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  readonly #reading = new EventReading();
  readonly #down = new Set<string>();
  #keys: KeyMap = DEFAULT_KEYS;
  #ways: readonly Way[] = WAYS;

  get readMs(): number {
    return this.#reading.readMs;
  }

  get pushed(): boolean {
    const { forward, left, sideways } = this.wish;
    return forward !== 0 || left !== 0 || sideways !== undefined;
  }

  get held(): boolean {
    return this.#any('grip');
  }

  /** Other keys drive from now on. Whatever is held counts as released. */
  setKeys(keys: KeyMap): void {
    this.#keys = keys;
    this.releaseAll();
  }

  /** Whether the robot goes sideways: otherwise those keys are none of this input's. Whatever is held counts as released. */
  setSideways(goesSideways: boolean): void {
    this.#ways = goesSideways ? [...WAYS, ...SIDEWAYS_ROLES] : WAYS;
    this.releaseAll();
  }

  /** Keys stay down between events for as long as the page runs: call this regularly while it does. */
  runs(nowMs: number): void {
    this.#reading.runs(nowMs);
  }

  /** @param code KeyboardEvent.code @param nowMs of now, not of the event @returns whether this input uses the key */
  key(code: string, down: boolean, nowMs: number): boolean {
    if (!this.#keys.grip.includes(code) && !this.#ways.some((way) => this.#keys[way].includes(code)))
      return false;
    const wasHeld = this.held;
    if (down) this.#down.add(code);
    else this.#down.delete(code);
    // A new grip and an open one are news of the hand. A repeated key says nothing about the time before it.
    if (!wasHeld || !this.held) this.#reading.told(nowMs);
    this.wish.forward = Number(this.#any('forward')) - Number(this.#any('back'));
    this.wish.left = Number(this.#any('left')) - Number(this.#any('right'));
    const [toLeft, toRight] = SIDEWAYS_ROLES;
    this.wish.sideways = Number(this.#any(toLeft)) - Number(this.#any(toRight)) || undefined;
    return true;
  }

  /** Call this when the page no longer receives key events. No key counts as held after it. */
  releaseAll(): void {
    this.#down.clear();
    this.wish.forward = 0;
    this.wish.left = 0;
    this.wish.sideways = undefined;
  }

  /**
   * Shift types a question mark, and may be a grip: it counts as released, unless a key for a direction is held with it.
   *
   * @returns whether the keyboard's grip was held and is open now
   */
  letGoOfShift(nowMs: number): boolean {
    if (!this.held || this.#ways.some((way) => this.#any(way))) return false;
    for (const code of ['ShiftLeft', 'ShiftRight']) this.key(code, false, nowMs);
    return !this.held;
  }

  #any(role: 'grip' | Way): boolean {
    return this.#keys[role].some((code) => this.#down.has(code));
  }
}
