import { longProperty } from '@farpoint/network-sim/cases';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { CHAIN_START, makeEntry, sha256 } from './audit-entry.ts';
import { ChainVerifier } from './chain-verifier.ts';
import { readTail } from './log-tail.ts';
import { chainOf, EVENTS, verify } from './testing/chain.ts';

const lines = chainOf(EVENTS);
const text = lines.join('');
const starts = lines.map((_, i) => Buffer.byteLength(lines.slice(0, i).join('')));
const index = fc.nat(lines.length - 1);

describe('a chain', () => {
  it('as written has no fault, in one file or in several', () => {
    const whole = {
      entries: 5,
      torn: 0,
      first: { sequence: 0 },
      last: { sequence: 4 },
      containsExpected: null,
    };
    expect(verify([text])).toMatchObject(whole);
    expect(verify([lines.slice(0, 2).join(''), '', lines.slice(2).join('')])).toMatchObject(whole);
    // The last newline says nothing.
    expect(verify([text.slice(0, -1)])).toMatchObject(whole);
    expect(verify(['', ''])).toMatchObject({ kind: 'empty' });
  });

  it('with any byte changed has a fault at its entry', () => {
    const bytes = Buffer.from(text);
    fc.assert(
      fc.property(fc.nat(bytes.byteLength - 1), fc.integer({ min: 1, max: 255 }), (at, by) => {
        const changed = Buffer.from(bytes);
        changed[at] = (changed[at]! + by) % 256;
        const entry = starts.findLastIndex((start) => start <= at);
        const kind = at === bytes.byteLength - 1 ? 'torn' : 'changed';
        expect(verify([changed])).toMatchObject({ kind, entry, place: { file: 'f0', line: entry + 1 } });
      }),
      longProperty(2, 4000),
    );
  });

  it('says which entry is missing, also if it is the first, and is only complete up to its last', () => {
    fc.assert(
      fc.property(fc.nat(lines.length - 2), (gone) => {
        const left = lines.filter((_, i) => i !== gone);
        expect(verify([left.join('')])).toMatchObject({
          kind: 'missing',
          entry: gone,
          place: { line: gone + 1 },
        });
      }),
    );
    // Nobody can tell that the end was cut off, unless it was noted elsewhere.
    const cut = lines.slice(0, 3).join('');
    expect(verify([cut])).toMatchObject({ entries: 3 });
    const expected = readTail(Buffer.from(text))?.end.previous;
    expect(verify([text], { expected })).toMatchObject({ containsExpected: true });
    expect(verify([cut], { expected })).toMatchObject({ containsExpected: false });
  });

  it('may begin later if older files are elsewhere', () => {
    const late = lines.slice(2).join('');
    expect(verify([late])).toMatchObject({ kind: 'missing', entry: 0 });
    expect(verify([late], { partial: true })).toMatchObject({ first: { sequence: 2 }, entries: 3 });
    const damaged = verify([late.replace('lease', 'peace')], { partial: true });
    expect(damaged).toMatchObject({ kind: 'changed', entry: 2, place: { line: 1 } });
  });

  it('says which entry was moved', () => {
    fc.assert(
      fc.property(index, index, (a, b) => {
        fc.pre(a !== b);
        const moved = [...lines];
        [moved[a], moved[b]] = [moved[b]!, moved[a]!];
        expect(verify([moved.join('')])).toMatchObject({ kind: 'reordered', entry: Math.min(a, b) });
      }),
    );
  });

  it('says what was inserted', () => {
    fc.assert(
      fc.property(index, index, (copied, after) => {
        const more = [...lines];
        more.splice(after + 1, 0, lines[copied]!);
        // A copy that is put before its original is what comes too early.
        const kind = copied > after + 1 ? 'reordered' : 'inserted';
        const entry = Math.min(copied, after + 1);
        fc.pre(copied !== after + 1);
        expect(verify([more.join('')])).toMatchObject({ kind, entry });
      }),
    );
    const { line } = makeEntry(CHAIN_START, { kind: 'stopped' }, 5);
    expect(verify([text + line])).toMatchObject({ kind: 'inserted', entry: 0 });
    expect(verify([`${lines[0]}\n${lines[1]}`])).toMatchObject({ kind: 'inserted', entry: 1 });
    expect(verify([`${lines[0]}rubbish\n${lines[1]}`])).toMatchObject({ kind: 'inserted', entry: 1 });
  });

  it('says which entry was replaced by one with a hash of its own', () => {
    const end = readTail(Buffer.from(lines[0]!))!.end;
    const forged = makeEntry(end, { kind: 'estop-released' }, 1e12).line;
    const replaced = [lines[0], forged, ...lines.slice(2)].join('');
    expect(verify([replaced])).toMatchObject({ kind: 'changed', entry: 1, place: { line: 2 } });
    const other = makeEntry({ sequence: 0, previous: 'a'.repeat(64) }, { kind: 'started' }, 0).line;
    expect(verify([other])).toMatchObject({ kind: 'changed', entry: 0 });
  });

  it('takes bytes in pieces of any size, and lines of any length', () => {
    fc.assert(
      fc.property(fc.integer({ min: 1, max: 400 }), (size) => {
        const bytes = Buffer.from(text);
        const verifier = new ChainVerifier();
        verifier.beginFile('f');
        for (let at = 0; at < bytes.length; at += size) verifier.push(bytes.subarray(at, at + size));
        expect(verifier.end()).toMatchObject({ entries: 5 });
      }),
    );
    expect(verify([`${lines[0]}${'x'.repeat(200_000)}\n${lines[1]}`])).toMatchObject({
      kind: 'inserted',
      entry: 1,
    });
  });
});

it('arbitrary files are refused without an exception', () => {
  const piece = fc.oneof(
    fc.uint8Array({ maxLength: 50 }),
    fc.constantFrom(...lines.map((line) => Buffer.from(line))),
  );
  fc.assert(
    fc.property(
      fc.array(fc.array(piece, { maxLength: 8 }), { maxLength: 3 }),
      fc.boolean(),
      (files, partial) => {
        const result = verify(
          files.map((pieces) => Buffer.concat(pieces)),
          { partial },
        );
        if (!('kind' in result))
          expect(result.last.sequence - result.first.sequence).toBe(result.entries - 1);
      },
    ),
    longProperty(3, 2000),
  );
});

describe('a torn entry', () => {
  /** What a log looks like after a crash and the next start. */
  const recovered = (left: Uint8Array) => {
    const tail = readTail(left)!;
    const { torn, end, endsLine } = tail;
    const notes = torn === null ? [] : [{ kind: 'torn-entry', details: { ...torn } } as const];
    let at = end;
    const more = [...notes, { kind: 'started' } as const].map((event) => {
      const made = makeEntry(at, event, 2e12);
      at = made.end;
      return made.line;
    });
    return Buffer.concat([left, Buffer.from(`${endsLine ? '' : '\n'}${more.join('')}`)]);
  };

  it('wherever the crash was, is recorded as such', () => {
    const bytes = Buffer.from(text);
    // Within a line, every seventh byte is like its neighbours.
    const isNearAnEnd = (cut: number) => [...starts, bytes.length].some((start) => Math.abs(cut - start) < 4);
    for (let cut = starts[1]!; cut <= bytes.length; cut++) {
      if (cut % 7 !== 0 && !isNearAnEnd(cut)) continue;
      const left = bytes.subarray(0, cut);
      const whole = starts.includes(cut) || starts.includes(cut + 1) || cut >= bytes.length - 1;
      expect(verify([left]), String(cut)).toMatchObject(whole ? { torn: 0 } : { kind: 'torn' });
      const after = recovered(left);
      expect(verify([after]), String(cut)).toMatchObject({ torn: whole ? 0 : 1 });
      // A second crash while that was recorded.
      for (const again of [cut + 1, cut + 2, cut + 50, after.length - 3])
        expect(verify([recovered(after.subarray(0, again))]), `${cut}, ${again}`).not.toHaveProperty('kind');
    }
  });

  it('excuses these bytes and no others', () => {
    const left = Buffer.from(text.slice(0, -10));
    const after = recovered(left);
    const from = starts[4]!;
    for (let at = from; at < left.length; at++) {
      const changed = Buffer.from(after);
      changed[at] = changed[at]! ^ 1;
      expect(verify([changed]), String(at)).toHaveProperty('kind');
    }
    const without = Buffer.concat([after.subarray(0, from), after.subarray(left.length + 1)]);
    expect(verify([without])).toMatchObject({ kind: 'missing', entry: 4 });
  });

  it('may end with zeros, as a file system leaves them', () => {
    const left = Buffer.concat([Buffer.from(lines[0]!), Buffer.alloc(5000)]);
    expect(verify([recovered(left)])).toMatchObject({ entries: 3, torn: 1 });
    expect(readTail(left)?.torn).toEqual({ bytes: 5000, sha256: sha256(Buffer.alloc(5000)) });
  });
});
