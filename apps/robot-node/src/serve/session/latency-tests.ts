import type { SharedFrame } from '../../send/transport/shared-frame.ts';

/** A latency test that is waiting for its green frame. */
export interface LatencyTest {
  id: number;
  commandMs: number;
}

/** More tests than this wait only if the operator misbehaves. */
const MAX_WAITING = 16;

/** One operator's latency tests: those waiting for a green frame, and those whose frame is being sent. */
export class LatencyTests {
  #waiting: LatencyTest[] = [];
  #lastId: number | null = null;
  readonly #inFlight = new Map<SharedFrame, LatencyTest[]>();

  /** @returns false if the test is already known: the operator repeats a request until it is answered */
  ask(test: LatencyTest): boolean {
    if (test.id === this.#lastId) return false;
    this.#lastId = test.id;
    this.#add(test);
    return true;
  }

  /** A frame is about to be sent. @returns the tests that it answers: all waiting tests if it is green, else none */
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

  /** The frame was not sent completely. @returns whether any tests wait again because of that */
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
