import { emptyPlacement, writePlacement, writePointPacketHeader } from '@farpoint/protocol';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { describe, expect, test } from 'vitest';
import { BATCHES_AHEAD, FLUSH_AFTER_MS, ReceivePipeline } from './pipeline.ts';
import type { FromCloudWorker } from './worker-messages.ts';

const codec = await loadCodecFromDisk();

/** An assembler on a simulated clock, and the messages that it posted. */
class Bench {
  nowMs = 1000;
  readonly told: FromCloudWorker[] = [];
  #timer: { act: () => void; dueMs: number } | null = null;
  readonly assembler = new ReceivePipeline({
    post: (message) => this.told.push(message),
    nowMs: () => this.nowMs,
    timeOriginMs: 5_000_000,
    setTimer: (act, afterMs) => {
      this.#timer = { act, dueMs: this.nowMs + afterMs };
      return 1;
    },
    clearTimer: () => {
      this.#timer = null;
    },
  });

  wait(ms: number): void {
    this.nowMs += ms;
    const timer = this.#timer;
    if (timer === null || this.nowMs < timer.dueMs) return;
    this.#timer = null;
    timer.act();
  }

  get batches() {
    return this.told.filter((message) => message.type === 'batch');
  }
}

/** A `points64` packet of 10 points, the `index`th of `count` of its frame. */
function packet(frameNumber: number, index = 0, count = 1): ArrayBuffer {
  const buffer = new ArrayBuffer(16 + 80 + 28);
  const view = new DataView(buffer);
  const header = { frameNumber, frameLength: count * 80, sequenceOffset: index * 80, sequenceLength: 80 };
  writePointPacketHeader(view, 0, header);
  writePlacement(view, 96, emptyPlacement());
  return buffer;
}

function bench(): Bench {
  const made = new Bench();
  made.assembler.begin(1, codec);
  return made;
}

describe('ReceivePipeline', () => {
  test('hands a frame over with its last packet', () => {
    const { assembler, batches, told } = bench();
    assembler.take(packet(1, 0, 2), 0, 1000);
    expect(batches).toEqual([]);
    assembler.take(packet(1, 1, 2), 1, 1000);
    expect(told).toMatchObject([{ type: 'batch', generation: 1, packets: 2, points: 20 }]);
  });

  test('never mixes sensors in a batch, and decodes each by its own stream', () => {
    const it = bench();
    const of = (sensor: number) => {
      const buffer = packet(1, 0, 2);
      writePlacement(new DataView(buffer), 96, { ...emptyPlacement(), sensor });
      return buffer;
    };
    for (const [i, sensor] of [0, 1, 1, 0].entries()) it.assembler.take(of(sensor), i, 1000);
    it.wait(FLUSH_AFTER_MS);
    expect(it.batches).toMatchObject([
      { sensor: 0, packets: 1 },
      { sensor: 1, packets: 2 },
      { sensor: 0, packets: 1 },
    ]);
    // Beyond the maximum number of sensors.
    it.assembler.take(of(200), 4, 1000);
    it.assembler.report();
    expect(it.told.at(-1)).toMatchObject({ drops: { 'no-stream': 1 } });
  });

  test('hands over the received part of a frame whose last packet is missing', () => {
    const it = bench();
    it.assembler.take(packet(1, 0, 2), 0, 1000);
    it.wait(FLUSH_AFTER_MS - 1);
    expect(it.batches).toEqual([]);
    it.wait(1);
    expect(it.batches).toMatchObject([{ packets: 1, points: 10 }]);
  });

  test('fills buffers while the page is behind, and continues when one comes back', () => {
    const it = bench();
    for (let frame = 1; frame <= BATCHES_AHEAD + 2; frame++) it.assembler.take(packet(frame), frame, 1000);
    it.wait(FLUSH_AFTER_MS);
    expect(it.batches).toHaveLength(BATCHES_AHEAD);
    const [first] = it.batches;
    it.assembler.giveBack(first!.buffer);
    it.wait(FLUSH_AFTER_MS);
    expect(it.batches.at(-1)).toMatchObject({ packets: 2, points: 20 });
  });

  test('drops and counts packets that waited too long', () => {
    const it = bench();
    it.assembler.take(packet(1), 0, 1000);
    it.assembler.take(packet(2), 1, 800);
    it.assembler.report();
    expect(it.told.at(-1)).toMatchObject({ type: 'report', drops: { 'decoder-behind': 1 } });
  });

  test('counts a coded packet without its stream header, and refuses an invalid header', () => {
    const it = bench();
    const coded = packet(1);
    writePlacement(new DataView(coded), 96, { ...emptyPlacement(), format: 'organised' });
    it.assembler.take(coded, 0, 1000);
    it.assembler.beginStream(codec, 'organised', new Uint8Array(3));
    expect(it.told).toMatchObject([{ type: 'streamRefused', generation: 1, format: 'organised' }]);
    it.assembler.report();
    expect(it.told.at(-1)).toMatchObject({ drops: { 'no-stream': 1 } });
  });

  test('a new session forgets what was not handed over, and restarts the counters', () => {
    const it = bench();
    it.assembler.take(packet(1, 0, 2), 0, 1000);
    it.assembler.begin(2, codec);
    it.assembler.take(packet(1), 0, 1000);
    it.assembler.report();
    expect(it.told).toMatchObject([
      { type: 'batch', generation: 2, packets: 1 },
      { type: 'report', generation: 2, packetsReceived: 1 },
    ]);
  });

  test('reports only if packets have arrived since the last report', () => {
    const it = bench();
    it.assembler.report();
    it.assembler.take(packet(1, 0, 2), 0, 1000);
    it.assembler.report();
    it.assembler.report();
    expect(it.told.filter(({ type }) => type === 'report')).toHaveLength(2);
  });
});
