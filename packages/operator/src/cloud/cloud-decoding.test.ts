import { emptyPlacement, writePlacement, writePointPacketHeader } from '@farpoint/protocol';
import type { Codec } from '@farpoint/wasm-codec';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { beforeAll, expect, test } from 'vitest';
import { CloudDecoding, type EncodedPayload } from './cloud-decoding.ts';
import type { FromCloudWorker } from './worker-messages.ts';

let codec: Codec;
beforeAll(async () => {
  codec = await loadCodecFromDisk();
});

function decode(loading: Promise<Codec>) {
  const told: FromCloudWorker[] = [];
  const decoding = new CloudDecoding(loading, {
    post: (message) => told.push(message),
    nowMs: () => 1000,
    timeOriginMs: 0,
    setTimer: () => 1,
    clearTimer: () => undefined,
  });
  return { decoding, told };
}

/** A `points64` packet that is a whole frame of 10 points. */
function payload(frameNumber: number): EncodedPayload {
  const data = new ArrayBuffer(16 + 80 + 28);
  const view = new DataView(data);
  writePointPacketHeader(view, 0, {
    ...{ frameNumber, frameLength: 80, sequenceOffset: 0, sequenceLength: 80 },
  });
  writePlacement(view, 96, emptyPlacement());
  return { data, getMetadata: () => ({ sequenceNumber: frameNumber }) };
}

/** A receiver's stream, fed by the test. */
function receiver() {
  let controller: ReadableStreamDefaultController<EncodedPayload> | undefined;
  let cancelled = false;
  const readable = new ReadableStream<EncodedPayload>({
    start: (given) => {
      controller = given;
    },
    cancel: () => {
      cancelled = true;
    },
  });
  return {
    readable,
    push: (frame: number) => controller?.enqueue(payload(frame)),
    end: () => controller?.close(),
    get cancelled() {
      return cancelled;
    },
  };
}

test('is ready once the codec is loaded, and decodes packets that came before', async () => {
  const { decoding, told } = decode(Promise.resolve(codec));
  const { readable, push, end } = receiver();
  const consumed = decoding.consume(readable, 1);
  push(1);
  push(2);
  end();
  await consumed;
  expect(told.map(({ type }) => type)).toEqual(['ready', 'batch', 'batch']);
});

test('leaves the stream of an older session when a newer one begins', async () => {
  const { decoding, told } = decode(Promise.resolve(codec));
  const older = receiver();
  const newer = receiver();
  const consumed = [decoding.consume(older.readable, 1), decoding.consume(newer.readable, 2)];
  older.push(1);
  newer.push(1);
  newer.end();
  await Promise.all(consumed);
  const batches = told.filter((message) => message.type === 'batch');
  expect(batches).toMatchObject([{ generation: 2, points: 10 }]);
  expect(older.cancelled).toBe(true);
});

test('tells the page if the codec cannot be loaded, and takes nothing', async () => {
  const { decoding, told } = decode(Promise.reject(new Error('blocked by policy')));
  const { readable, push, end } = receiver();
  push(1);
  end();
  await decoding.consume(readable, 1);
  decoding.onMessage({
    ...{ type: 'cloudStream', generation: 1, sensor: 0, format: 'organised', header: new Uint8Array() },
  });
  expect(told).toEqual([{ type: 'failed', message: 'blocked by policy' }]);
});
