import fc from 'fast-check';
import { expect, test } from 'vitest';
import { LastPictures, type PictureStorage } from './last-pictures.ts';

const NOW_MS = 1_800_000_000_000;
const DAY_MS = 86_400_000;
const jpeg = (text: string) => `data:image/jpeg;base64,${btoa(text)}`;

class Stored extends Map<string, string> implements PictureStorage {
  getItem = (key: string) => this.get(key) ?? null;
  setItem = (key: string, value: string) => void this.set(key, value);
  removeItem = (key: string) => void this.delete(key);
  key = (i: number) => [...this.keys()][i] ?? null;
  get length() {
    return this.size;
  }
}
const open = (stored: PictureStorage, nowMs = NOW_MS, origin = 'wss://a.example') =>
  new LastPictures(origin, () => stored, nowMs);

test('keeps the last of each robot, also for the next visit, and apart for each service', () => {
  const stored = new Stored();
  const pictures = open(stored);
  expect(pictures.of('a')).toBeNull();
  pictures.keep('a', jpeg('first'), NOW_MS);
  pictures.keep('a', jpeg('second'), NOW_MS + 1);
  const last = { url: jpeg('second'), drawnMs: NOW_MS + 1 };
  expect(pictures.of('a')).toEqual(last);
  expect(open(stored).of('a')).toEqual(last);
  expect(open(stored, NOW_MS, 'wss://b.example').of('a')).toBeNull();
  expect(stored.size).toBe(1);
});

test('forgets what is old, and the robot that was seen longest ago when there are too many', () => {
  const stored = new Stored();
  const pictures = open(stored);
  for (let i = 0; i < 32; i++) pictures.keep(`r${i}`, jpeg('x'), NOW_MS + i);
  pictures.keep('r0', jpeg('again'), NOW_MS + 1000);
  pictures.keep('new', jpeg('x'), NOW_MS + 1001);
  const seen = (of: LastPictures) => ['r0', 'r1', 'new'].map((id) => of.of(id) !== null);
  expect(seen(pictures)).toEqual([true, false, true]);
  expect(stored.size).toBe(32);
  expect(seen(open(stored, NOW_MS + 1000 + DAY_MS))).toEqual([false, false, true]);
  expect(stored.size).toBe(1);
});

test('keeps no picture of more than 20 kB, and nothing but JPEG', () => {
  const stored = new Stored();
  const pictures = open(stored);
  const longest = jpeg('x'.repeat(20_000));
  pictures.keep('a', longest, NOW_MS);
  pictures.keep('a', jpeg('x'.repeat(20_500)), NOW_MS + 1);
  pictures.keep('a', 'data:image/svg+xml;base64,AAAA', NOW_MS + 2);
  pictures.keep('a', 'https://example.org/a.jpg', NOW_MS + 3);
  expect(pictures.of('a')).toEqual({ url: longest, drawnMs: NOW_MS });
});

test('removes what it cannot read, whatever is stored, and nothing of others', () => {
  fc.assert(
    fc.property(fc.string(), (text) => {
      const stored = new Stored([
        ['farpoint.picture wss://a.example a', text],
        ['farpoint.panels', text],
      ]);
      expect(open(stored).of('a')).toBeNull();
      expect([...stored.keys()]).toEqual(['farpoint.panels']);
    }),
  );
});

test('lasts as long as the page where the browser keeps nothing', () => {
  const pictures = new LastPictures(
    'wss://a.example',
    () => {
      throw new Error('denied');
    },
    NOW_MS,
  );
  pictures.keep('a', jpeg('x'), NOW_MS);
  expect(pictures.of('a')?.drawnMs).toBe(NOW_MS);
});
