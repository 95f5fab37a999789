import type { ReceiverSums } from '@farpoint/congestion';
import { emptyPlacement } from '@farpoint/protocol';
import type { ReportBlock } from '@farpoint/rtp';
import type { ReadyFrame } from '../../../sense/capture/capture-messages.ts';
import { completePackets, SLOT_BYTES } from '../../../sense/encode/packetiser.ts';
import type { RtpTransport } from '../rtp-transport.ts';

export interface Sent {
  atMs: number;
  first: number;
  bytes: number;
  timestamp: number;
  marker: boolean;
}

/** A path whose other end is the test. */
export class RecordingTransport implements RtpTransport {
  readonly ssrc = 1;
  readonly overheadBytes = 68;
  ready = true;
  transportFeedback = true;
  onRtcp: ((compound: Uint8Array) => void) | null = null;
  readonly sent: Sent[] = [];
  readonly resendRefusals = { unknown: 0, 'too-late': 0, resent: 0 };
  readonly resent: number[] = [];
  readonly #now: () => number;

  constructor(now: () => number) {
    this.#now = now;
  }

  send(payload: Uint8Array, timestamp: number, marker: boolean): number | null {
    if (!this.ready) return null;
    this.sent.push({
      atMs: this.#now(),
      first: payload[0] as number,
      bytes: payload.length,
      timestamp,
      marker,
    });
    return (this.sent.length - 1) & 0xffff;
  }

  /** Reports on stream 1, of which 100 packets were sent before. */
  receiverSums({ ssrc, highestSequence, packetsLost }: Readonly<ReportBlock>): ReceiverSums | null {
    if (ssrc !== 1) return null;
    return { packetsReceived: highestSequence - 99 - packetsLost, packetsLost, source: 'rtcp', rttMs: 40 };
  }

  resend(sequence: number): number {
    this.resent.push(sequence);
    return sequence === 9 ? 0 : 1300;
  }
}

/** A frame whose packets begin with their number. */
export function frame(points: number, capturedAtMs = 1000): ReadyFrame {
  const packets = Math.ceil(points / 150);
  const buffer = new ArrayBuffer(packets * SLOT_BYTES);
  const slots = new Uint8Array(buffer);
  completePackets(slots, 0, points, emptyPlacement());
  for (let i = 0; i < packets; i++) slots[i * SLOT_BYTES] = i;
  return {
    type: 'frame',
    sensor: 0,
    usefulBitsPerSecond: 1e6,
    audience: 'everyone',
    format: 'points64',
    frameNumber: 0,
    points,
    packets,
    validPoints: points,
    rejected: { notFinite: 0, nonPositiveDepth: 0, outOfRange: 0, notDrawn: 0 },
    saturated: 0,
    sampleMs: 0,
    packMs: 0,
    buffer,
    latencyTest: false,
    intervalMs: 1000,
    capturedAtMs,
    captureMs: 0,
    inMemoryMs: capturedAtMs,
    captureCpuMs: 0,
    readyMs: capturedAtMs,
  };
}
