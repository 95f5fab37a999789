import type { WholePicture } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { DecodeQueue } from './decode-queue.ts';

const picture = (camera: number, pictureId: number): WholePicture => ({
  ...{ format: 'jpeg', camera, width: 4, height: 3, pictureId, captureTimeUs: 0 },
  bytes: new Uint8Array(1),
});

test('decodes one picture per camera, keeps the newest waiting and counts those skipped', () => {
  const tickets: number[] = [];
  const queue = new DecodeQueue(({ ticket }) => tickets.push(ticket));
  for (const id of [1, 2, 3]) queue.add(picture(0, id));
  queue.add(picture(1, 9));
  expect(tickets).toEqual([1, 2]);
  expect(queue.ended(1)?.pictureId).toBe(1);
  expect(tickets).toEqual([1, 2, 3]);
  expect(queue.ended(3)?.pictureId).toBe(3);
  expect(queue.ended(2)?.camera).toBe(1);
  expect(queue.superseded).toBe(1);
});

test('does not show pictures of the previous robot', () => {
  const queue = new DecodeQueue(() => undefined);
  queue.add(picture(0, 1));
  queue.clear();
  queue.add(picture(0, 2));
  expect(queue.ended(1)).toBe(null);
  expect(queue.ended(2)?.pictureId).toBe(2);
});

test('never decodes more than one picture per camera, and accounts for each', () => {
  fc.assert(
    fc.property(fc.array(fc.oneof(fc.nat(3), fc.constant(null)), { maxLength: 100 }), (steps) => {
      const open: number[] = [];
      const queue = new DecodeQueue(({ ticket }) => open.push(ticket));
      let [added, ended] = [0, 0];
      for (const camera of steps) {
        if (camera !== null) {
          queue.add(picture(camera, added++));
        } else if (open.length > 0) {
          expect(queue.ended(open.shift() as number)).not.toBe(null);
          ended++;
        }
        expect(open.length).toBeLessThanOrEqual(4);
      }
      const left = added - ended - queue.superseded;
      expect(left).toBeGreaterThanOrEqual(0);
      expect(left).toBeLessThanOrEqual(8);
    }),
  );
});
