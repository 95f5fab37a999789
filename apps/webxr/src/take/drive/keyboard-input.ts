/** W, A, S, D or the arrow keys, while Space or Shift is held. Pure: the caller passes in the codes of the keys. */
import type { DriveInput, DriveWish } from '@farpoint/operator';
import { EventReading } from './event-reading.ts';

const GRIPS: readonly string[] = ['Space', 'ShiftLeft', 'ShiftRight'];
const FORWARD: readonly string[] = ['KeyW', 'ArrowUp'];
const BACK: readonly string[] = ['KeyS', 'ArrowDown'];
const LEFT: readonly string[] = ['KeyA', 'ArrowLeft'];
const RIGHT: readonly string[] = ['KeyD', 'ArrowRight'];
const KEYS: ReadonlySet<string> = new Set([...GRIPS, ...FORWARD, ...BACK, ...LEFT, ...RIGHT]);

export class KeyboardInput implements DriveInput {
  readonly name = 'keyboard';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  readonly #reading = new EventReading();
  readonly #down = new Set<string>();

  get readMs(): number {
    return this.#reading.readMs;
  }

  get held(): boolean {
    return this.#any(GRIPS);
  }

  /** Keys stay down between events for as long as the page runs: call this regularly while it does. */
  runs(nowMs: number): void {
    this.#reading.runs(nowMs);
  }

  /** @param code KeyboardEvent.code @param nowMs of now, not of the event @returns whether this input uses the key */
  key(code: string, down: boolean, nowMs: number): boolean {
    if (!KEYS.has(code)) return false;
    const wasHeld = this.held;
    if (down) this.#down.add(code);
    else this.#down.delete(code);
    // A new grip and an open one are news of the hand. A repeated key says nothing about the time before it.
    if (!wasHeld || !this.held) this.#reading.told(nowMs);
    this.wish.forward = Number(this.#any(FORWARD)) - Number(this.#any(BACK));
    this.wish.left = Number(this.#any(LEFT)) - Number(this.#any(RIGHT));
    return true;
  }

  /** Call this when the page no longer receives key events. No key counts as held after it. */
  releaseAll(): void {
    this.#down.clear();
    this.wish.forward = 0;
    this.wish.left = 0;
  }

  #any(codes: readonly string[]): boolean {
    return codes.some((code) => this.#down.has(code));
  }
}
