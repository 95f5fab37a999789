import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { MAX_AHEAD, TsnWindow } from './tsn-window.ts';

/** The same, as simply as possible: the numbers relative to the first, in a set. */
class Model {
  last = 0;
  readonly #ahead = new Set<number>();

  add(number: number): boolean {
    if (number <= this.last || number > this.last + MAX_AHEAD || this.#ahead.has(number)) return false;
    this.#ahead.add(number);
    this.#advance();
    return true;
  }

  skipTo(number: number): boolean {
    if (number <= this.last) return false;
    this.last = number;
    this.#advance();
    return true;
  }

  blocks(): [number, number][] {
    const blocks: [number, number][] = [];
    for (const number of [...this.#ahead].sort((a, b) => a - b)) {
      const block = blocks.at(-1);
      if (block !== undefined && block[1] === number - this.last - 1) block[1]++;
      else blocks.push([number - this.last, number - this.last]);
    }
    return blocks;
  }

  #advance(): void {
    while (this.#ahead.has(this.last + 1)) this.last++;
    for (const number of this.#ahead) if (number <= this.last) this.#ahead.delete(number);
  }
}

describe('TsnWindow', () => {
  it('knows what arrived, in any order, with losses, repetitions and skips, also where the numbers wrap', () => {
    const step = fc.record({
      skips: fc.boolean(),
      /** Relative to the last number in order, mostly near. */
      ahead: fc.oneof(
        { weight: 9, arbitrary: fc.integer({ min: -5, max: 40 }) },
        fc.integer({ max: 9000, min: -9000 }),
      ),
    });
    fc.assert(
      fc.property(fc.array(step, { maxLength: 200 }), fc.constantFrom(0, 7, 2 ** 32 - 20), (steps, first) => {
        const [window, model] = [new TsnWindow(first), new Model()];
        for (const { skips, ahead } of steps) {
          const number = model.last + ahead;
          const tsn = (first + number) >>> 0;
          if (skips && ahead % 5 === 0) expect(window.skipTo(tsn)).toBe(model.skipTo(number));
          else expect(window.add(tsn)).toBe(model.add(number));
          expect(window.last).toBe((first + model.last) >>> 0);
          const blocks = model.blocks();
          expect(window.blocks(9999)).toEqual(blocks);
          expect(window.blocks(2)).toEqual(blocks.slice(0, 2));
          expect(window.hasGaps).toBe(blocks.length > 0);
          for (const [start] of blocks) expect(window.has(first + model.last + start)).toBe(true);
          if (blocks.length > 0) expect(window.has((window.last + 1) >>> 0)).toBe(false);
        }
      }),
      { seed: 5, numRuns: 300 },
    );
  });

  it('holds as many numbers as it reaches, and no more', () => {
    const window = new TsnWindow(0);
    expect(window.add(MAX_AHEAD + 1)).toBe(false);
    for (let tsn = MAX_AHEAD; tsn > 1; tsn--) expect(window.add(tsn)).toBe(true);
    expect(window.blocks(10)).toEqual([[2, MAX_AHEAD]]);
    expect(window.add(1)).toBe(true);
    expect(window.last).toBe(MAX_AHEAD);
    expect(window.hasGaps).toBe(false);
  });
});
