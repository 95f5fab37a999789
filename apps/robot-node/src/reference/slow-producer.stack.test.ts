/**
 * The robot program with a camera of the reference system that is slower than the rate that the robot was told, and a
 * stand-in for the reference system's released bridge, which reports each frame's rate.
 */
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { ReleasedBridge, ReleasedPage } from '@farpoint/conformance/testing';
import { LocalStack } from '@farpoint/local-stack';
import { isAvailable, ReferenceFrameProducer } from '@farpoint/shared-memory';
import { afterEach, describe, expect, it } from 'vitest';

const ROBOT = 'shm-1';
const POINTS = 9000;
const BYTES_PER_POINT = 8;
const PRODUCED_EVERY_MS = 100;
const WATCHED_FRAMES = 40;

const cleanups: (() => unknown)[] = [];
afterEach(async () => {
  for (const cleanup of cleanups.splice(0).reverse()) await cleanup();
}, 30_000);

describe.skipIf(!isAvailable())(
  'a slow producer in shared memory (needs the addon: pnpm build:native)',
  () => {
    it('is sent whole to the released bridge, whatever rate was declared', { timeout: 60_000 }, async () => {
      const folder = mkdtempSync(join(tmpdir(), 'farpoint-slow-producer-'));
      cleanups.push(() => rmSync(folder, { recursive: true, force: true }));
      const producer = new ReferenceFrameProducer(folder);
      cleanups.push(() => producer.close());
      const cloud = new Uint8Array(POINTS * BYTES_PER_POINT).fill(1);
      const producing = setInterval(() => producer.publish(cloud), PRODUCED_EVERY_MS);
      cleanups.push(() => clearInterval(producing));
      // The stand-in gives too little transport feedback for an adaptive rate: only its reports are to count.
      const args = [
        '--source',
        'shm',
        '--shm-folder',
        folder,
        '--shm-layout',
        'reference',
        '--fps',
        '18',
        '--rate-control',
        'fixed',
      ];
      const stack = await LocalStack.start({ robots: [{ id: ROBOT, name: ROBOT, args, reference: true }] });
      cleanups.push(() => stack.stop());
      const bridge = await ReleasedBridge.start();
      cleanups.push(() => bridge.stop());
      const page = await ReleasedPage.load(bridge.sockets, `ws://127.0.0.1:${stack.ports.referenceClient}`);
      cleanups.push(() => page.close());
      await page.listed(ROBOT);
      await bridge.ready(ROBOT);
      await page.switchTo(ROBOT);
      const sizes: number[] = [];
      while (sizes.length < WATCHED_FRAMES) sizes.push((await page.points()).length / BYTES_PER_POINT);
      // A loaded machine may make a frame partial.
      const last = sizes.slice(-10).sort((a, b) => a - b);
      expect(last[5]).toBe(POINTS);
    });
  },
);
