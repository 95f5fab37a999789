import fc from 'fast-check';
import { expect, it } from 'vitest';
import { decodeJson, encodeJson } from './json.ts';
import { operatorSessionCodec, robotSessionCodec } from './session-codecs.ts';

function reads(text: string): boolean {
  try {
    decodeJson(operatorSessionCodec, new TextEncoder().encode(JSON.stringify({ type: 'chat', text })));
    return true;
  } catch {
    return false;
  }
}

it('a line has at most 200 characters, whatever its script', () => {
  expect([reads('✓'.repeat(200)), reads('✓'.repeat(201))]).toEqual([true, false]);
  expect([reads('😀'.repeat(200)), reads('😀'.repeat(201))]).toEqual([true, false]);
});

it('the longest line by the longest name fits a message of the robot', () => {
  const from = { number: 2 ** 32 - 1, name: '"'.repeat(64), claimed: true } as const;
  for (const text of ['"'.repeat(200), '😀'.repeat(200), '✓'.repeat(200), '\\'.repeat(200)]) {
    const line = { type: 'chatLine', number: 2 ** 32 - 1, from, yours: false, text, agoS: 1e9 } as const;
    expect(decodeJson(robotSessionCodec, encodeJson(robotSessionCodec, line))).toEqual(line);
  }
});

it('whatever is read is one line that says something, and comes out as it went in', () => {
  let read = 0;
  const unit = fc.oneof(
    fc.string({ unit: 'binary', maxLength: 3 }),
    fc.constantFrom('\n', '\u202e', ' ', 'a'),
  );
  fc.assert(
    fc.property(fc.array(unit, { maxLength: 120 }), (parts) => {
      const text = parts.join('');
      if (!reads(text)) return;
      read++;
      expect([...text].length).toBeLessThanOrEqual(200);
      expect(text.trim()).not.toBe('');
      expect(text.isWellFormed()).toBe(true);
      expect(/[\p{Cc}\u2028\u2029\u202a-\u202e\u2066-\u2069]/u.test(text)).toBe(false);
    }),
    { seed: 7, numRuns: 2000 },
  );
  expect(read).toBeGreaterThan(50);
});
