import { describe, expect, test } from 'vitest';
import { AccessList } from './access.ts';
import { Admission } from './admission.ts';
import { turnCredentials } from './ice-servers.ts';
import { parseTokens } from './token-file.ts';

describe('tokens', () => {
  const free = (...tokens: string[]) => ({ bound: new Map(), free: tokens });

  test.each([
    ['lines', 'abc\n# a comment\ndef\n', free('abc', 'def')],
    ['one line', 'abc', free('abc')],
    ['numbers', '00123\n1e10\n0x1F\n', free('00123', '1e10', '0x1F')],
    ['a number', '0123456789\n', free('0123456789')],
    ['a number below a comment', '# of the kitchen\n\n00123\n', free('00123')],
    [
      'a list of what is no text in YAML',
      '- 00123\n- 1e10\n- 0x1F\n- 1.50\n- true\n',
      free('00123', '1e10', '0x1F', '1.50', 'true'),
    ],
    ['more digits than a number has', '[12345678901234567890123]', free('12345678901234567890123')],
    ['aliases', '- &a 007\n- *a\n', free('007', '007')],
    [
      'a mapping to numbers',
      'r1: 00123\n7: [+5]\n',
      {
        bound: new Map([
          ['r1', ['00123']],
          ['7', ['+5']],
        ]),
        free: [],
      },
    ],
    ['a YAML list', '- abc\n- "d e"\n', free('abc', 'd e')],
    ['a JSON list', '["abc"]', free('abc')],
    [
      'a YAML mapping',
      'r1: abc\nr2: [def, ghi]\n',
      {
        bound: new Map([
          ['r1', ['abc']],
          ['r2', ['def', 'ghi']],
        ]),
        free: [],
      },
    ],
    ['a JSON mapping', '{"r1":"abc"}', { bound: new Map([['r1', ['abc']]]), free: [] }],
  ])('from %s', (_, content, tokens) => {
    expect(parseTokens(content, true)).toEqual(tokens);
  });

  test('operator names do not bind tokens', () => {
    expect(parseTokens('Ada Lovelace: abc', false)).toEqual(free('abc'));
  });

  test.each([
    ['', 'has no tokens'],
    ['# only\n# comments', 'has no tokens'],
    ['{}', 'has no tokens'],
    ['r1:', 'r1: a token is text of 1–4096 characters'],
    ['r1: null', 'r1: a token is text of 1–4096 characters'],
    ['- ~', 'entry 1: a token is text of 1–4096 characters'],
    ['- ""', 'entry 1: a token is text of 1–4096 characters'],
    ['r1: a\nr1: secret', 'is neither YAML nor JSON nor one token a line'],
    ['r1: *secret', 'r1: a token is text of 1–4096 characters'],
    ['&a [*a]', 'entry 1: a token is text of 1–4096 characters'],
    ['R 1: secret', '"R 1" is not a robot id'],
    ['r1: {a: secret}', 'r1: a token is text of 1–4096 characters'],
    ['- secret\n- [x]', 'entry 2: a token is text of 1–4096 characters'],
    ['{"a": "secret"', 'is neither YAML nor JSON nor one token a line'],
  ])('%j is refused without being quoted', (content, message) => {
    let thrown = '';
    try {
      parseTokens(content, true);
    } catch (error) {
      thrown = (error as Error).message;
    }
    expect(thrown).toBe(message);
    expect(thrown).not.toContain('secret');
  });

  test('without tokens everybody is admitted; with an empty set, nobody', () => {
    expect(new AccessList(null).allows(undefined, 'r1')).toBe(true);
    const closed = new AccessList(free());
    expect(closed.open).toBe(false);
    expect(closed.allows(undefined, null)).toBe(false);
    expect(closed.allows('', null)).toBe(false);
  });

  test('a token bound to one robot is valid for that robot and for connecting at all', () => {
    const list = new AccessList({ bound: new Map([['r1', ['abc']]]), free: [] });
    expect([list.allows('abc', 'r1'), list.allows('abc', 'r2'), list.allows('abc', null)]).toEqual([
      true,
      false,
      true,
    ]);
  });
});

describe('admission', () => {
  test('counts in total and by address, and releases places', () => {
    const admission = new Admission({ maxConnections: 3, maxConnectionsPerAddress: 2 });
    const leave = admission.enter('192.0.2.1');
    admission.enter('192.0.2.1');
    expect(admission.refusal('192.0.2.1')).toBe('too-many-connections-per-address');
    expect(admission.refusal('192.0.2.2')).toBeNull();
    admission.enter('192.0.2.2');
    expect(admission.refusal('192.0.2.3')).toBe('too-many-connections');
    leave();
    expect(admission.refusal('192.0.2.1')).toBeNull();
    expect(admission.total).toBe(2);
  });
});

test('creates TURN credentials as coturn checks them', () => {
  // echo -n 1700003600:r1 | openssl dgst -sha1 -hmac secret -binary | base64
  expect(
    turnCredentials({ urls: ['turn:a'], secret: 'secret', ttlSeconds: 3600 }, 'r1', 1_700_000_000.7),
  ).toEqual({
    urls: ['turn:a'],
    username: '1700003600:r1',
    credential: 'uaxcLwlwqCDX/aJ/oXjxjex31Ts=',
  });
});
