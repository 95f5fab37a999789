import { expect, it } from 'vitest';
import type { OfferedPicture } from './picture-messages.ts';
import { PictureTap } from './picture-tap.ts';

const facts = { kind: 'raw', width: 2, height: 1, step: 2, encoding: 'mono8', bigEndian: false } as const;

function setUp(most: (number | null)[] = [null, null]) {
  const sent: OfferedPicture[] = [];
  const tap = new PictureTap({ postMessage: (picture) => sent.push(structuredClone(picture)) }, most);
  const show = (camera: number, nowMs: number) => {
    if (!tap.wants(camera, nowMs)) return false;
    tap.offer({ camera, capturedAtMs: nowMs, facts, data: Uint8Array.from([camera, nowMs & 0xff]) });
    return true;
  };
  return { tap, sent, show };
}

it('wants nothing until somebody watches, and then no more than planned', () => {
  const { tap, sent, show } = setUp();
  expect(show(0, 0)).toBe(false);
  tap.onReport({ type: 'rates', perSecond: [5, 0] });
  for (let ms = 0; ms < 10_000; ms += 20) {
    // Plans are updated all the time.
    if (ms % 260 === 0) tap.onReport({ type: 'rates', perSecond: [5 + (ms % 3) / 10, 0] });
    show(0, ms);
    expect(show(1, ms)).toBe(false);
    tap.onReport({ type: 'done', camera: 0, room: new ArrayBuffer(2) });
  }
  expect(sent.length).toBeGreaterThanOrEqual(50);
  expect(sent.length).toBeLessThanOrEqual(53);
});

it('stays within the topic’s limit', () => {
  const { tap, sent, show } = setUp([2, null]);
  tap.onReport({ type: 'rates', perSecond: [10, 10] });
  for (let ms = 0; ms < 10_000; ms += 100) {
    show(0, ms);
    tap.onReport({ type: 'done', camera: 0, room: new ArrayBuffer(2) });
  }
  expect(sent.length).toBeGreaterThanOrEqual(20);
  expect(sent.length).toBeLessThanOrEqual(21);
});

it('has one picture per camera in progress; takes the newest next, and counts those skipped', () => {
  const { tap, sent, show } = setUp();
  tap.onReport({ type: 'rates', perSecond: [10, 10] });
  expect(show(0, 0)).toBe(true);
  expect([100, 200, 300].map((ms) => show(0, ms))).toEqual([false, false, false]);
  expect(show(1, 300)).toBe(true);
  tap.onReport({ type: 'done', camera: 0, room: new ArrayBuffer(8) });
  expect(show(0, 400)).toBe(true);
  expect(sent.map(({ camera, capturedAtMs, missed }) => [camera, capturedAtMs, missed])).toEqual([
    [0, 0, 0],
    [1, 300, 0],
    [0, 400, 3],
  ]);
  expect([...(sent[2]?.data ?? [])]).toEqual([0, 400 & 0xff]);
});
