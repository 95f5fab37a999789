import fc from 'fast-check';
import { expect, it } from 'vitest';
import { coversRobot, robotPatternSchema } from './grant-claims.ts';
import { exportOperatorKey, importOperatorKey, keyThumbprint, makeOperatorKey } from './operator-key.ts';
import { soleFingerprint } from './sole-fingerprint.ts';
import { decodeTicket, encodeTicket } from './ticket.ts';

it.each([
  ['kitchen-1', 'kitchen-1', true],
  ['kitchen-1', 'kitchen-12', false],
  ['*', 'kitchen-1', true],
  ['kitchen-*', 'kitchen-', true],
  ['kitchen-*', 'kitchen', false],
  ['*-1', 'hall-1', true],
  ['k*n-*1', 'kitchen-21', true],
  ['k*n-*1', 'kitchen-12', false],
  ['ab*ba', 'aba', false],
  ['ab*ba', 'abba', true],
  ['a*b*b*c', 'abc', false],
  ['a.c', 'abc', false],
])('%s covers %s: %s', (pattern, id, covers) => {
  expect(robotPatternSchema.safeParse(pattern).success).toBe(true);
  expect(coversRobot([pattern], id)).toBe(covers);
});

it('patterns match as regular expressions would', () => {
  const letters = (extra: string) => fc.string({ unit: fc.constantFrom('a', 'b', ...extra), maxLength: 12 });
  fc.assert(
    fc.property(letters('*'), letters(''), (pattern, id) => {
      const expression = new RegExp(`^${pattern.replaceAll('*', '.*')}$`);
      expect(coversRobot([pattern], id)).toBe(expression.test(id));
    }),
    { seed: 8, numRuns: 2000 },
  );
});

it('a ticket gives the grant and the key back; nothing else is one', async () => {
  const key = await makeOperatorKey(true);
  const text = encodeTicket({ grant: 'a.b.c', key: await exportOperatorKey(key) });
  const ticket = decodeTicket(text);
  expect(ticket?.grant).toBe('a.b.c');
  const again = await importOperatorKey(ticket!.key);
  expect(await keyThumbprint(again.publicJwk)).toBe(await keyThumbprint(key.publicJwk));
  expect(decodeTicket(text.slice(0, -8))).toBeNull();
  fc.assert(
    fc.property(fc.string(), (rest) => {
      expect(decodeTicket(rest)).toBeNull();
      expect(decodeTicket(`farpoint-ticket.${rest}`)).toBeNull();
    }),
    { seed: 9 },
  );
});

const pair = (byte: string) => Array.from({ length: 32 }, () => byte).join(':');
it.each([
  [[`a=fingerprint:sha-256 ${pair('ab')}`], pair('AB')],
  [[`a=fingerprint:sha-256 ${pair('ab')}`, 'm=audio', `a=fingerprint:SHA-256 ${pair('AB')}`], pair('AB')],
  [[`a=fingerprint:sha-256 ${pair('ab')}`, `a=fingerprint:sha-256 ${pair('ac')}`], null],
  [[`a=fingerprint:sha-256 ${pair('ab')}`, `a=fingerprint:sha-512 ${pair('ab')}`], null],
  [[`a=fingerprint:sha-256 ${pair('ab')} `], null],
  [[`a=fingerprint:sha-256 ${pair('ab')}`, `a=x:fingerprint`], null],
  [['a=mid:0'], null],
])('the one fingerprint of %j', (lines, expected) => {
  for (const end of ['\r\n', '\n', '\r']) expect(soleFingerprint(lines.join(end))).toBe(expected);
});
