import fc from 'fast-check';
import { beforeEach, describe, expect, test } from 'vitest';
import { CODE_MS, MOST_GUESSES, PAUSE_MS, PairingCodes } from './pairing-codes.ts';

let shown: string[];
let next: number;
let codes: PairingCodes;
beforeEach(() => {
  shown = [];
  next = 4217;
  codes = new PairingCodes({
    random: (below) => {
      expect(below).toBe(1_000_000);
      return next++;
    },
    onCode: (digits) => shown.push(digits),
  });
});

describe('a pairing code', () => {
  test('has six digits, and pairs one browser', () => {
    expect(codes.ask(0)).toBe(true);
    expect(shown).toEqual(['004217']);
    expect(codes.guess('004217', 1)).toBe('paired');
    expect(codes.guess('004217', 2)).toBe('expired');
  });

  test('is typed with or without spaces', () => {
    codes.ask(0);
    expect(codes.guess(' 004 217', 1)).toBe('paired');
  });

  test('is not there until a browser waits', () => {
    expect(codes.guess('004217', 0)).toBe('expired');
    expect(shown).toEqual([]);
  });

  test('is the same for browsers that wait at once, and a new one after five minutes', () => {
    codes.ask(0);
    codes.ask(CODE_MS - 1);
    expect(shown).toEqual(['004217']);
    expect(codes.guess('004217', CODE_MS)).toBe('expired');
    codes.ask(CODE_MS);
    expect(shown).toEqual(['004217', '004218']);
    expect(codes.guess('004217', CODE_MS)).toBe('wrong');
    expect(codes.guess('004218', CODE_MS)).toBe('paired');
  });

  test('ends with wrong guesses, and then there is none for a while', () => {
    codes.ask(0);
    for (let i = 1; i < MOST_GUESSES; i++) expect(codes.guess('999999', 0)).toBe('wrong');
    expect(codes.guess('999999', 0)).toBe('used-up');
    expect(codes.ask(1)).toBe(false);
    expect(codes.guess('004217', PAUSE_MS - 1)).toBe('paused');
    expect(codes.ask(PAUSE_MS)).toBe(true);
    expect(codes.guess('004218', PAUSE_MS)).toBe('paired');
  });

  test('however it is guessed, lets in by the code alone, and few guesses an hour', () => {
    fc.assert(
      fc.property(
        fc.array(fc.tuple(fc.integer({ min: 0, max: 60_000 }), fc.boolean(), fc.string())),
        (steps) => {
          let nowMs = 0;
          let code = '';
          const guesses: number[] = [];
          const some = new PairingCodes({ random: () => 123_456, onCode: (digits) => (code = digits) });
          for (const [waitMs, asks, typed] of steps) {
            nowMs += waitMs;
            if (asks) some.ask(nowMs);
            const answer = some.guess(typed, nowMs);
            expect(answer === 'paired').toBe(
              answer !== 'paused' && typed.replace(/[\s-]/g, '') === code && code !== '',
            );
            if (answer === 'wrong' || answer === 'used-up') guesses.push(nowMs);
          }
          const hour = 3_600_000;
          for (const from of guesses)
            expect(guesses.filter((at) => at >= from && at < from + hour).length).toBeLessThanOrEqual(
              MOST_GUESSES * (hour / PAUSE_MS + 1),
            );
        },
      ),
    );
  });
});
