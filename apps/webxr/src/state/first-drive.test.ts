import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { TOUR_STEPS } from '../words/tour-words.ts';
import { type DriveFacts, FirstDrive } from './first-drive.ts';

const idle: DriveFacts = { holds: false, moves: false, stop: 'off' };

describe('the first drive', () => {
  test('goes on by what is seen, in order', () => {
    const tour = new FirstDrive();
    const after = (facts: Partial<DriveFacts>) => {
      tour.see({ ...idle, ...facts });
      return tour.step.value;
    };
    expect(after({})).toBe('grip');
    // It moves, but not by this hand.
    expect(after({ moves: true })).toBe('grip');
    expect(after({ holds: true })).toBe('drive');
    expect(after({ moves: true })).toBe('drive');
    expect(after({ holds: true, moves: true })).toBe('stop');
    expect(after({ stop: 'other' })).toBe('stop');
    expect(after({ stop: 'yours' })).toBe('release');
    expect(after({ stop: 'yours' })).toBe('release');
    expect(after({})).toBe('done');
    expect(after({ holds: true })).toBe('done');
  });

  test('a robot that is stopped has not been driven', () => {
    const tour = new FirstDrive();
    tour.see({ holds: true, moves: true, stop: 'other' });
    expect(tour.step.value).toBe('grip');
    tour.see({ holds: true, moves: true, stop: 'off' });
    expect(tour.step.value).toBe('stop');
  });

  test('steps can be skipped; without STOP there is nothing to release', () => {
    const tour = new FirstDrive();
    tour.skip();
    expect(tour.step.value).toBe('drive');
    tour.skip();
    tour.skip();
    expect(tour.step.value).toBe('done');
    tour.skip();
    expect(tour.step.value).toBe('done');
  });

  test('never goes back, and ends with a release only after this operator’s own STOP', () => {
    const facts = fc.record({
      holds: fc.boolean(),
      moves: fc.boolean(),
      stop: fc.constantFrom('off' as const, 'yours' as const, 'other' as const),
    });
    fc.assert(
      fc.property(fc.array(facts, { maxLength: 40 }), (seen) => {
        const tour = new FirstDrive();
        const order = [...TOUR_STEPS, 'done'];
        let at = 0;
        for (const each of seen) {
          tour.see(each);
          const now = order.indexOf(tour.step.value);
          expect(now).toBeGreaterThanOrEqual(at);
          at = now;
        }
        if (tour.step.value === 'done') expect(seen.some(({ stop }) => stop === 'yours')).toBe(true);
      }),
    );
  });
});
