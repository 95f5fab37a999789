import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { CHAIN_START, MAX_LINE_BYTES, makeEntry, readEntry, shortHash } from './audit-entry.ts';
import { canonicalJson, type JsonValue } from './canonical-json.ts';
import { chainOf, EVENTS } from './testing/chain.ts';

/** Any code points. `fc.string` with the unit `binary` takes seconds to begin. */
const anyText = fc
  .array(fc.nat(0x10ffff), { maxLength: 300 })
  .map((codes) => String.fromCodePoint(...codes).toWellFormed());

const bytesOf = (line: string) => Buffer.from(line.replace(/\n$/, ''));

describe('canonicalJson', () => {
  it('sorts members by UTF-16 code units, as in RFC 8785, 3.2.3', () => {
    const text = canonicalJson({
      '\u20ac': 1,
      '\r': 2,
      '\ufb33': 3,
      '1': 4,
      '\ud83d\ude00': 5,
      '\u0080': 6,
      '\u00f6': 7,
    });
    expect(Object.values(JSON.parse(text.replace('"1"', '"x1"')))).toEqual([2, 4, 6, 7, 1, 5, 3]);
  });

  it('leaves out undefined, and writes what JSON can say', () => {
    expect(canonicalJson({ b: undefined, a: [Number.NaN, 1e30, '\ud800'] })).toBe(
      '{"a":[null,1e+30,"\ufffd"]}',
    );
  });

  it('is the same for the same value, whatever its text was', () => {
    fc.assert(
      fc.property(fc.jsonValue(), (value) => {
        const text = canonicalJson(value as JsonValue);
        expect(canonicalJson(JSON.parse(text) as JsonValue)).toBe(text);
      }),
    );
  });
});

describe('entries', () => {
  it('are read as they were written, each with the hash of the one before', () => {
    const entries = chainOf(EVENTS).map((line) => readEntry(bytesOf(line)));
    expect(entries.map((entry) => entry?.sequence)).toEqual([0, 1, 2, 3, 4]);
    for (const [i, entry] of entries.entries()) {
      expect(entry?.previous).toBe(i === 0 ? '0'.repeat(64) : entries[i - 1]?.hash);
      const { kind, subject, session, details } = EVENTS[i]!;
      expect(entry).toMatchObject(JSON.parse(JSON.stringify({ kind, subject, session, details })));
    }
  });

  it('are canonical JSON with the SHA-256 of everything else in them', () => {
    const { line } = makeEntry(CHAIN_START, { kind: 'stopped', robot: 'r1' }, 0);
    expect(line).toBe(
      '{"hash":"' +
        'c376f0a0f0252fdb36e2a3a4952a55dbf64ae1cf5136c57b6ffc70f6f8165d76' +
        '","kind":"stopped","previous":"' +
        '0'.repeat(64) +
        '","robot":"r1","sequence":0,"time":"1970-01-01T00:00:00.000Z","version":1}\n',
    );
  });

  it('are cut if their details are too long, and say so', () => {
    const { line } = makeEntry(
      CHAIN_START,
      { kind: 'started', details: { text: 'é'.repeat(MAX_LINE_BYTES) } },
      0,
    );
    expect(readEntry(bytesOf(line))?.details).toEqual({
      tooLong: 2 * MAX_LINE_BYTES + 11,
      sha256: expect.stringMatching(/^[0-9a-f]{64}$/),
    });
  });

  it('whatever names and details contain, can be read', () => {
    const text = anyText;
    fc.assert(
      fc.property(text, fc.dictionary(text, fc.jsonValue()), (name, details) => {
        const event = { kind: 'refused', subject: { name, proven: false }, details } as never;
        expect(readEntry(bytesOf(makeEntry(CHAIN_START, event, 0).line))).not.toBeNull();
      }),
    );
  });

  it('of arbitrary bytes are refused without an exception', () => {
    fc.assert(fc.property(fc.uint8Array({ maxLength: 500 }), (bytes) => readEntry(bytes) === null));
    fc.assert(fc.property(fc.json(), (text) => readEntry(Buffer.from(text)) === null));
  });
});

it('a secret has another name for each purpose', () => {
  expect(shortHash('session', 'abc')).toMatch(/^[0-9a-f]{12}$/);
  expect(shortHash('session', 'abc')).not.toBe(shortHash('token', 'abc'));
});
