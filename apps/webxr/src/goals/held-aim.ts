/** A trigger that aims at the floor: held there for a moment and then let go of, it names a goal. Time is an argument. */
import type { FloorPlace } from './floor-pick.ts';

/** So long the trigger must have pointed at the floor, ms: nobody does that by mistake. */
export const AIM_MS = 600;

/** What a trigger meant that was let go of. */
export type Aimed = { kind: 'goal'; place: FloorPlace } | { kind: 'click' } | { kind: 'nothing' };

export class HeldAim {
  /** The hand that aims; `null` while none does. */
  hand: number | null = null;
  /** Where it points at the floor; `null` if it does not. */
  place: FloorPlace | null = null;
  #pulledMs = 0;
  #floorMs: number | null = null;

  /** A trigger is pulled. The hand that aims already goes on. */
  pull(hand: number, nowMs: number): void {
    if (this.hand !== null) return;
    this.cancel();
    this.hand = hand;
    this.#pulledMs = nowMs;
  }

  /** @param place where the hand points now */
  point(place: FloorPlace | null, nowMs: number): void {
    if (this.hand === null) return;
    this.place = place;
    this.#floorMs = place === null ? null : (this.#floorMs ?? nowMs);
  }

  /** Whether letting go now names the goal. */
  isReady(nowMs: number): boolean {
    return this.place !== null && this.#floorMs !== null && nowMs - this.#floorMs >= AIM_MS;
  }

  /** Nothing comes of this pull. */
  cancel(): void {
    this.hand = null;
    this.place = null;
    this.#floorMs = null;
  }

  /** The trigger is let go of. */
  letGo(hand: number, nowMs: number): Aimed {
    if (hand !== this.hand) return { kind: 'nothing' };
    const { place } = this;
    const isReady = this.isReady(nowMs);
    const isClick = nowMs - this.#pulledMs < AIM_MS;
    this.cancel();
    if (isReady && place !== null) return { kind: 'goal', place };
    return { kind: isClick ? 'click' : 'nothing' };
  }
}
