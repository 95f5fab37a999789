import type { SharedFrame } from '../transport/shared-frame.ts';

/** A latency test that waits for its green frame. */
export interface LatencyTest {
  id: number;
  commandMs: number;
}

/** More tests than this wait only where the operator misbehaves. */
const MAX_WAITING = 16;

/** One operator's latency tests: those that wait for a green frame, and those whose frame is on its way. */
export class LatencyTests {
  #waiting: LatencyTest[] = [];
  #lastId: number | null = null;
  readonly #inFlight = new Map<SharedFrame, LatencyTest[]>();

  /** @returns false where the test is known: the operator repeats a request until it is answered. */
  ask(test: LatencyTest): boolean {
    if (test.id === this.#lastId) return false;
    this.#lastId = test.id;
    this.#add(test);
    return true;
  }

  /** A frame is about to be sent. @returns the tests that it answers: all that wait, where it is green */
  answeredBy(shared: SharedFrame): readonly LatencyTest[] {
    if (!shared.frame.latencyTest || this.#waiting.length === 0) return [];
    const answered = this.#waiting;
    this.#waiting = [];
    this.#inFlight.set(shared, answered);
    return answered;
  }

  onSent(shared: SharedFrame): void {
    this.#inFlight.delete(shared);
  }

  /** The frame was not sent whole. @returns whether tests wait again because of it */
  onLost(shared: SharedFrame): boolean {
    const tests = this.#inFlight.get(shared);
    if (tests === undefined) return false;
    this.#inFlight.delete(shared);
    for (const test of tests) this.#add(test);
    return true;
  }

  clear(): void {
    this.#waiting = [];
    this.#inFlight.clear();
  }

  #add(test: LatencyTest): void {
    this.#waiting.push(test);
    if (this.#waiting.length > MAX_WAITING) this.#waiting.shift();
  }
}
