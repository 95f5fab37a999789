import { VIDEO_CODECS, type VideoCodec } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { bestCodec, CodecChoice, type CodecWatcher } from './codec-choice.ts';

const BOTH: readonly VideoCodec[] = ['H264', 'VP8'];
const watcher = (codecs: readonly VideoCodec[], drives = false): CodecWatcher => ({
  codecs: new Set(codecs),
  drives,
});
const all = watcher(BOTH);
const h264 = watcher(['H264']);
const vp8 = watcher(['VP8']);
const none = watcher([]);

const watchers = fc.array(
  fc.record({
    codecs: fc.uniqueArray(fc.constantFrom(...VIDEO_CODECS)).map((codecs) => new Set(codecs)),
    drives: fc.boolean(),
  }),
  { maxLength: 6 },
);
const available = fc.uniqueArray(fc.constantFrom(...VIDEO_CODECS), { minLength: 1 });
const isServed =
  (codec: VideoCodec) =>
  ({ codecs }: CodecWatcher) =>
    codecs.has(codec);

describe('the best codec', () => {
  it.each([
    ['nobody', [], 'H264'],
    ['those who decode all', [all, all], 'H264'],
    ['one who decodes VP8 only', [vp8], 'VP8'],
    ['all of several', [all, vp8, all], 'VP8'],
    ['a driver, before the majority', [watcher(['VP8'], true), h264, h264], 'VP8'],
    ['the majority, where the driver decodes both', [watcher(BOTH, true), h264, vp8, vp8], 'VP8'],
    ['the majority, where the driver decodes none', [watcher([], true), h264, vp8, vp8], 'VP8'],
    ['one of two', [vp8, h264], 'H264'],
    ['somebody, whoever cannot decode anything', [none, vp8], 'VP8'],
  ] as const)('for %s', (_, each, expected) => {
    expect(bestCodec(BOTH, each)).toBe(expected);
  });

  it('is the encoder’s only one, whoever watches', () => {
    expect(bestCodec(['VP8'], [h264])).toBe('VP8');
  });

  it('is one that all decode, if there is one; else the driver’s, else one that serves no fewer than others', () => {
    fc.assert(
      fc.property(available, watchers, (codecs, each) => {
        const best = bestCodec(codecs, each);
        expect(codecs).toContain(best);
        const forAll = codecs.filter((codec) => each.every(isServed(codec)));
        if (forAll.length > 0) {
          expect(best).toBe(forAll[0]);
          return;
        }
        const drivers = each.filter(({ drives }) => drives);
        if (codecs.some((codec) => drivers.some(isServed(codec))))
          expect(drivers.some(isServed(best))).toBe(true);
        else {
          const served = codecs.map((codec) => each.filter(isServed(codec)).length);
          expect(each.filter(isServed(best)).length).toBe(Math.max(...served));
        }
      }),
    );
  });
});

describe('the choice over time', () => {
  it('changes at once for one who would see nothing, and back when that has served everyone for a while', () => {
    const choice = new CodecChoice(BOTH);
    expect(choice.update([all], true, 0)).toBe('H264');
    expect(choice.update([all, vp8], false, 1000)).toBe('VP8');
    expect(choice.update([all], false, 60_000)).toBe('VP8');
    expect(choice.update([all], false, 64_999)).toBe('VP8');
    expect(choice.update([all], false, 65_000)).toBe('H264');
  });

  it('stays while somebody comes and goes', () => {
    const choice = new CodecChoice(BOTH);
    let changes = 0;
    let before = choice.update([all, vp8], true, 0);
    for (let nowMs = 0; nowMs <= 60_000; nowMs += 1000) {
      const codec = choice.update((nowMs / 1000) % 4 === 0 ? [all, vp8] : [all], false, nowMs);
      if (codec !== before) changes++;
      before = codec;
    }
    expect([before, changes]).toEqual(['VP8', 0]);
  });

  it('costs nobody the picture for another than the driver, unless that is better for a while', () => {
    const choice = new CodecChoice(BOTH);
    choice.update([h264], true, 0);
    expect(choice.update([h264, vp8, vp8], false, 1000)).toBe('H264');
    expect(choice.update([h264, vp8, vp8], false, 6000)).toBe('VP8');
    const drives = watcher(['H264'], true);
    expect(choice.update([drives, vp8, vp8], false, 6200)).toBe('H264');
  });

  it('changes freely while nothing is encoded', () => {
    const choice = new CodecChoice(BOTH);
    expect(choice.update([vp8], true, 0)).toBe('VP8');
    expect(choice.update([], true, 1)).toBe('H264');
    expect(choice.update([h264, vp8, vp8], true, 2)).toBe('VP8');
  });

  it('takes the picture from nobody without need, and gives one to everyone in the end', () => {
    fc.assert(
      fc.property(available, fc.array(watchers, { minLength: 1, maxLength: 20 }), (codecs, rounds) => {
        const choice = new CodecChoice(codecs);
        rounds.forEach((each, i) => {
          const before = choice.current;
          const codec = choice.update(each, false, i * 200);
          const gains = each.some((one) => one.codecs.has(codec) && !one.codecs.has(before));
          // Less than 5 s pass here: only those who see nothing are a reason.
          expect(codec === before || gains).toBe(true);
        });
        const last = rounds.at(-1) ?? [];
        choice.update(last, false, 10_000);
        expect(choice.update(last, false, 15_000)).toBe(bestCodec(codecs, last));
      }),
    );
  });
});
