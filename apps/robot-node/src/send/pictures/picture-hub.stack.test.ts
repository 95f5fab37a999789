/** The hub with its real thread: makes pictures, and reports those that cannot be shown. */
import type { MessagePort } from 'node:worker_threads';
import type { SourcePicture } from '@farpoint/cloud-source';
import { PICTURE_CHUNK_HEADER_BYTES, readPictureFile } from '@farpoint/protocol';
import { createLogger } from '@farpoint/service';
import { expect, it, onTestFinished } from 'vitest';
import type { ReadyPicture } from '../../sense/pictures/picture-messages.ts';
import { PictureTap } from '../../sense/pictures/picture-tap.ts';
import { PictureHub, type PictureTarget } from './picture-hub.ts';

/** A hub with a watcher, and the tap that a capture thread would have. */
async function setUp() {
  const made: ReadyPicture[] = [];
  const warned: unknown[] = [];
  const changed: (() => void)[] = [];
  const told = () => {
    for (const look of changed) look();
  };
  const until = (is: () => boolean) =>
    new Promise<void>((resolve) => {
      const look = () => {
        if (is()) resolve();
      };
      changed.push(look);
      look();
    });
  let tap: PictureTap | null = null;
  const usePictures = (port: MessagePort) => {
    const taker = new PictureTap(port, [null]);
    port.on('message', (report) => {
      taker.onReport(report);
      told();
    });
    tap = taker;
  };
  const target: PictureTarget = {
    ...{ id: 'a', streaming: true, watchedCameras: new Set([0]), pictureBitsPerSecond: 1e6 },
    offerPicture: () => {},
  };
  const write = (line: string) => {
    warned.push(JSON.parse(line));
    told();
  };
  const log = createLogger({ name: 'test', level: 'warn', format: 'json', stream: { isTTY: false, write } });
  const hub = new PictureHub({
    policy: { perSecond: 30, longestSide: 64, quality: 80, share: 0.15 },
    capture: { cameras: [{ name: 'Front', most: null }], usePictures },
    targets: () => [target],
    driver: () => null,
    onMade: (picture) => {
      made.push(picture);
      told();
    },
    log,
  });
  onTestFinished(() => hub.close());
  hub.update(0);
  let nowMs = 0;
  const offer = async (picture: Omit<SourcePicture, 'camera'>) => {
    // Wait until a plan arrives and the previous picture is done.
    await until(() => {
      nowMs += 1000;
      return tap?.wants(0, nowMs) === true;
    });
    tap?.offer({ camera: 0, ...picture });
  };
  return { hub, made, warned, until, offer };
}

const facts = { kind: 'raw', width: 4, height: 2, step: 12, encoding: 'rgb8', bigEndian: false } as const;

it('makes a file from a picture, with its capture time', { timeout: 20_000 }, async () => {
  const { made, until, offer } = await setUp();
  // More than 32 bits of microseconds can hold.
  await offer({ capturedAtMs: 5_000_000.5, facts, data: new Uint8Array(24).fill(99) });
  await until(() => made.length === 1);
  const [picture] = made as [ReadyPicture];
  expect(picture).toMatchObject({ capturedAtMs: 5_000_000.5, header: { camera: 0, width: 4, height: 2 } });
  const file = Buffer.concat(picture.chunks.map((chunk) => chunk.subarray(PICTURE_CHUNK_HEADER_BYTES)));
  expect(file).toHaveLength(picture.fileBytes);
  expect(readPictureFile(file)).toEqual({ format: 'jpeg', width: 4, height: 2 });
});

it('says where an unusable picture was read, once for each fault', {
  timeout: 20_000,
}, async () => {
  const { hub, made, warned, until, offer } = await setUp();
  for (const byte of [100, 200])
    await offer({ capturedAtMs: 0, facts, data: new Uint8Array(20), origin: `/front: byte ${byte}` });
  await offer({ capturedAtMs: 0, facts: { ...facts, encoding: 'nv21' }, data: new Uint8Array(24) });
  await until(() => warned.length === 2);
  expect(warned).toMatchObject([
    {
      camera: 'Front',
      reason: 'bad-image',
      origin: '/front: byte 100',
      detail: expect.stringContaining('24'),
    },
    { camera: 'Front', reason: 'unsupported' },
  ]);
  expect(hub.counters.lost.get('bad-image')).toBe(2);
  expect(made).toEqual([]);
});
