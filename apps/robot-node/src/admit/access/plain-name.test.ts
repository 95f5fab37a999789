import { decodeJson, robotSessionCodec } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { plainName } from './plain-name.ts';

test.each([
  ['Ada', 'Ada'],
  ['Ada\u202eecarG', 'AdaecarG'],
  ['\u2067Ada\u2069', 'Ada'],
  ['Ada\u2028Grace\n', 'AdaGrace'],
  ['Ada\ud800', 'Ada\ufffd'],
  ['\u200f', '?'],
  [' ', '?'],
  [`${'x'.repeat(63)}\u{1f44d}`, `${'x'.repeat(63)}\ufffd`],
  ['👩‍🚀 Zoë', '👩‍🚀 Zoë'],
])('%j is shown as %j', (name, shown) => {
  expect(plainName(name)).toBe(shown);
});

test('whatever a name is, it fits into a message', () => {
  fc.assert(
    fc.property(fc.string({ unit: 'binary', maxLength: 100 }), (name) => {
      const cause = {
        type: 'estopCause',
        latch: 1,
        pressedBy: plainName(name),
        yours: false,
        release: 'driver',
      };
      expect(decodeJson(robotSessionCodec, JSON.stringify(cause))).toEqual(cause);
    }),
    { seed: 5, numRuns: 300 },
  );
});
