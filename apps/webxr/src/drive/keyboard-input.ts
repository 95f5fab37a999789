/** The keys that drive, while the grip is held. Pure: the caller passes in the codes of the keys. */
import type { DriveInput, DriveWish } from '@farpoint/operator';
import { DEFAULT_KEYS, type KeyMap } from './key-map.ts';

const WAYS = ['forward', 'back', 'left', 'right'] as const;

export class KeyboardInput implements DriveInput {
  readonly name = 'keyboard';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  readMs = Number.NEGATIVE_INFINITY;
  readonly #down = new Set<string>();
  #keys: KeyMap = DEFAULT_KEYS;
  #oneHanded = false;

  get held(): boolean {
    return this.#any('grip') || (this.#oneHanded && WAYS.some((way) => this.#any(way)));
  }

  /**
   * Whatever is held counts as released.
   *
   * @param oneHanded whether a key for a direction is the grip as well: held it drives, let go it stops
   */
  setKeys(keys: KeyMap, oneHanded: boolean): void {
    this.#keys = keys;
    this.#oneHanded = oneHanded;
    this.releaseAll();
  }

  /** Keys stay down between events for as long as the page runs: call this regularly while it does. */
  runs(nowMs: number): void {
    this.readMs = nowMs;
  }

  /** @param code KeyboardEvent.code @param nowMs of now, not of the event @returns whether this input uses the key */
  key(code: string, down: boolean, nowMs: number): boolean {
    if (!this.#keys.grip.includes(code) && !WAYS.some((way) => this.#keys[way].includes(code))) return false;
    const wasHeld = this.held;
    if (down) this.#down.add(code);
    else this.#down.delete(code);
    // A new grip and an open one are news of the hand. A repeated key says nothing about the time before it.
    if (!wasHeld || !this.held) this.readMs = nowMs;
    this.wish.forward = Number(this.#any('forward')) - Number(this.#any('back'));
    this.wish.left = Number(this.#any('left')) - Number(this.#any('right'));
    return true;
  }

  /** Call this when the page no longer receives key events. No key counts as held after it. */
  releaseAll(): void {
    this.#down.clear();
    this.wish.forward = 0;
    this.wish.left = 0;
  }

  #any(role: 'grip' | (typeof WAYS)[number]): boolean {
    return this.#keys[role].some((code) => this.#down.has(code));
  }
}
