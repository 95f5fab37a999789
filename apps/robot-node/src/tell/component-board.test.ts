import { longProperty } from '@farpoint/network-sim/cases';
import { type DiagnosticReport, decodeJson, encodeJson, telemetryCodec } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { ComponentBoard } from './component-board.ts';

/** Any code points. `fc.string` with the unit `binary` takes seconds to begin. */
const anyText = fc
  .array(fc.nat(0x10ffff), { maxLength: 300 })
  .map((codes) => String.fromCodePoint(...codes).toWellFormed());

const report = (name: string, level: DiagnosticReport['level'] = 'ok', message = ''): DiagnosticReport => ({
  ...{ name, level, message, sinceMs: 0 },
});

describe('ComponentBoard', () => {
  it('tells what has changed first, the most urgent first, and everything within a few turns', () => {
    const board = new ComponentBoard();
    expect(board.next(0)).toBeNull();
    const all = Array.from({ length: 20 }, (_, i) => report(`node ${i}`));
    board.take('/diagnostics', all, 100);
    const heard = new Set<string>();
    for (let turn = 1; turn <= 3; turn++) {
      board.take('/diagnostics', all, turn * 1000);
      for (const { name } of board.next(turn * 1000)?.reports ?? []) heard.add(name);
    }
    expect(heard.size).toBe(20);
    const changed = [
      ...all.slice(0, 17),
      report('node 17', 'warn'),
      report('node 18', 'error'),
      report('node 19'),
    ];
    board.take('/diagnostics', changed, 5000);
    const message = board.next(5000);
    expect(message?.counts).toEqual({ error: 1, warn: 1, stale: 0, ok: 18 });
    expect(message?.reports.slice(0, 2).map(({ name }) => name)).toEqual(['node 18', 'node 17']);
  });

  it('has nothing to say without news, but repeats itself for operators who connect later', () => {
    const board = new ComponentBoard();
    board.take('/diagnostics', [report('imu')], 100);
    expect(board.next(150)).toMatchObject({ timeMs: 100 });
    expect(board.next(200)).toBeNull();
    expect(board.next(2150)).toMatchObject({ timeMs: 100, reports: [{ name: 'imu' }] });
  });

  it('makes messages that fit the channel, whatever the texts', () => {
    const text = anyText;
    fc.assert(
      fc.property(fc.array(fc.tuple(text, text), { minLength: 1, maxLength: 12 }), (texts) => {
        const board = new ComponentBoard();
        board.take(
          `/${'d'.repeat(254)}`,
          texts.map(([name, message]) => report(name, 'stale', message)),
          1e9 + 0.1,
          true,
        );
        const message = board.next(1e9);
        expect(decodeJson(telemetryCodec, encodeJson(telemetryCodec, message!))).toEqual(message);
      }),
      longProperty(5, 200),
    );
  });
});
