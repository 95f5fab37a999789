/** The spots at which operators of the robot point now. Takes spots and the time; pure. */
import { type Operators, POINT_SHOWN_MS, type Spot } from '@farpoint/protocol';
import { nameWords } from '../words/handover-words.ts';
import { texts } from '../words/language.ts';

/**
 * Spots that are shown at once: a robot cannot make the page draw without end. Chosen: as many as operators are ever listed.
 * pointers.test.ts holds it.
 */
const MOST_POINTERS = 16;
/** Of this operator's own spot; the robot numbers others from 1. */
const OWN = 0;

interface Pointer {
  readonly at: Spot;
  readonly untilMs: number;
}

/**
 * Why nobody sees where this operator points: the robot does not pass it on, the grant does not let this operator point, or nobody
 * else is there.
 */
export type PointingBar = 'notPassedOn' | 'notPermitted' | 'alone';

/** @returns `null` if others see it */
export function pointingBar({ mayPoint, operators }: PointingSession): PointingBar | null {
  if (mayPoint === null) return 'notPassedOn';
  if (!mayPoint) return 'notPermitted';
  // A robot that lists nobody may have others.
  return operators === null || operators.operators.some(({ you }) => !you) ? null : 'alone';
}

export interface PointingSession {
  /** Whether the robot passes it on; `null`: it has not said so. */
  readonly mayPoint: boolean | null;
  /** As the robot lists them. */
  readonly operators: Operators | null;
}

/** A spot, and who points at it. */
export interface ShownPointer {
  /** The same for as long as it is the same operator. */
  readonly by: number;
  readonly name: string;
  readonly at: Spot;
}

export class Pointers {
  readonly #pointers = new Map<number, Pointer>();

  /** Another operator points. */
  take(by: number, at: Spot, nowMs: number): void {
    this.#pointers.delete(by);
    this.#pointers.set(by, { at, untilMs: nowMs + POINT_SHOWN_MS });
    for (const oldest of this.#pointers.keys()) {
      if (this.#pointers.size <= MOST_POINTERS) return;
      this.#pointers.delete(oldest);
    }
  }

  /** This operator points: it sees what the others see. */
  own(at: Spot, nowMs: number): void {
    this.take(OWN, at, nowMs);
  }

  /** Another robot's world is another one. */
  clear(): void {
    this.#pointers.clear();
  }

  /** @param operators as the robot lists them */
  shown(operators: Operators | null, nowMs: number): readonly ShownPointer[] {
    if (this.#pointers.size === 0) return NONE;
    for (const [by, { untilMs }] of this.#pointers) if (nowMs >= untilMs) this.#pointers.delete(by);
    return [...this.#pointers].map(([by, { at }]) => ({ by, at, name: nameOf(by, operators) }));
  }
}

const NONE: readonly ShownPointer[] = [];

function nameOf(by: number, operators: Operators | null): string {
  const said = texts().fleet.pointing;
  if (by === OWN) return said.you;
  const operator = operators?.operators.find(({ number }) => number === by);
  return operator === undefined ? said.somebody : nameWords(operator);
}
