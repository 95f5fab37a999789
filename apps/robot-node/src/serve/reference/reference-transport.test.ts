import { emptyPointPacketHeader, readPointPacketHeader } from '@farpoint/protocol';
import { expect, it } from 'vitest';
import type { RtpTransport } from '../../send/transport/rtp-transport.ts';
import { SharedFrame } from '../../send/transport/shared-frame.ts';
import type { ReadyFrame } from '../../sense/capture/capture-messages.ts';
import { completePackets, SLOT_BYTES } from '../../sense/encode/packetiser.ts';
import { toReferenceFrame } from './reference-operator.ts';
import { ReferenceTransport } from './reference-transport.ts';

interface Sent {
  payload: Uint8Array;
  timestamp: number;
  marker: boolean;
}

function fakeInner(sent: Sent[]): RtpTransport {
  return {
    ssrc: 1,
    overheadBytes: 64,
    ready: true,
    onRtcp: null,
    transportFeedback: true,
    receiverSums: () => null,
    resendRefusals: {} as RtpTransport['resendRefusals'],
    send: (payload, timestamp, marker) => sent.push({ payload: payload.slice(), timestamp, marker }),
    resend: () => 0,
  };
}

/** Data bytes count up, so that a misplaced byte is noticed. */
function capturedFrame(frameNumber: number, points: number): ReadyFrame {
  const packets = Math.ceil(points / 150);
  const slots = Uint8Array.from({ length: packets * SLOT_BYTES }, (_, i) => i & 0xff);
  completePackets(slots, frameNumber, points, {
    pose: { position: { x: 1, y: 2, z: 3 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
    captureTimeUs: 5,
    latencyTest: false,
    saturated: false,
    sensor: 0,
    format: 'points64',
  });
  return {
    buffer: slots.buffer,
    frameNumber,
    points,
    packets,
    intervalMs: 33,
    capturedAtMs: 0,
  } as ReadyFrame;
}

it('sends the same blocks with its own headers: whole packets, frames from 0, a clock of 90 kHz', () => {
  const sent: Sent[] = [];
  let now = 1000;
  const transport = new ReferenceTransport(fakeInner(sent), () => now);
  const shared = new SharedFrame(capturedFrame(77, 400), 0, () => undefined);
  for (const source of [shared, new SharedFrame(capturedFrame(79, 150), 0, () => undefined)]) {
    const frame = toReferenceFrame(source, transport.overheadBytes)!;
    for (let i = 0; i < frame.packets; i++) {
      const slot = frame.slots.subarray(i * SLOT_BYTES, i * SLOT_BYTES + 1244);
      transport.send(slot, frame.rtpTimestamp, i === frame.packets - 1, now, 33);
      now += 5;
    }
  }
  const header = emptyPointPacketHeader();
  const headers = sent.map(({ payload }) => {
    expect(payload.length).toBe(1216);
    expect(readPointPacketHeader(new DataView(payload.buffer), header)).toBeNull();
    return { ...header };
  });
  expect(headers).toEqual([
    { frameNumber: 0, frameLength: 2400, sequenceOffset: 0, sequenceLength: 1200 },
    { frameNumber: 0, frameLength: 2400, sequenceOffset: 1200, sequenceLength: 1200 },
    { frameNumber: 1, frameLength: 1200, sequenceOffset: 0, sequenceLength: 1200 },
  ]);
  expect(sent.map(({ marker }) => marker)).toEqual([false, true, true]);
  expect(sent.map(({ timestamp }) => timestamp)).toEqual([90_000, 90_000, 90_900]);
  expect(sent[1]?.payload.subarray(16)).toEqual(shared.slots.subarray(SLOT_BYTES + 16, SLOT_BYTES + 1216));
});

it('holds the buffer until both frames have released it', () => {
  const recycled: ArrayBuffer[] = [];
  const shared = new SharedFrame(capturedFrame(1, 300), 0, (buffer) => recycled.push(buffer));
  const frame = toReferenceFrame(shared, 36)!;
  shared.release();
  expect(recycled).toEqual([]);
  frame.release();
  expect(recycled.length).toBe(1);
  const small = new SharedFrame(capturedFrame(1, 149), 0, () => undefined);
  expect(toReferenceFrame(small, 36)).toBeNull();
});
