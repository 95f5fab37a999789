import {
  FixedRateController,
  type RateController,
  type RateDecision,
  type ReceiverSums,
} from '@farpoint/congestion';
import { describe, expect, it } from 'vitest';
import type { OutgoingFrame } from '../../ground/outgoing-frame.ts';
import type { ReadyFrame } from '../../sense/capture/capture-messages.ts';
import { SharedFrame } from './shared-frame.ts';
import { StreamSender } from './stream-sender.ts';
import { frame, RecordingTransport, type Sent } from './testing/recording-transport.ts';

/** Records what it is told about the receiver. */
class ReportedController extends FixedRateController {
  readonly told: (ReceiverSums | number)[] = [];

  override onReceiverReport(report: ReceiverSums): void {
    this.told.push(report);
  }

  override onReceiverLimit(bitsPerSecond: number): void {
    this.told.push(bitsPerSecond);
  }
}

/** Follows a script. */
class ScriptedController extends FixedRateController {
  readonly wanted: RateDecision;
  readonly clusters: number[] = [];
  inFlight = 0;

  constructor(bitsPerSecond: number) {
    super({ bitsPerSecond });
    this.wanted = { ...super.decision(0) };
  }

  override decision(): RateDecision {
    return { ...this.wanted, bytesInFlight: this.inFlight };
  }

  override onPacketSent(sequence: number, bytes: number, nowMs: number, probeCluster = 0): void {
    super.onPacketSent(sequence, bytes, nowMs);
    this.inFlight += bytes;
    this.clusters.push(probeCluster);
  }
}

function stage(
  bitsPerSecond = 10e6,
  controller: RateController = new FixedRateController({ bitsPerSecond }),
) {
  let nowMs = 0;
  const now = () => nowMs;
  const transport = new RecordingTransport(now);
  const sender = new StreamSender(transport, controller, now);
  const recycled: ArrayBuffer[] = [];
  const share = (captured: ReadyFrame) =>
    new SharedFrame(captured, transport.overheadBytes, (buffer) => recycled.push(buffer));
  /** Sends it to this operator only. */
  const send = (captured: ReadyFrame) => {
    const shared = share(captured);
    sender.enqueue(shared);
    shared.release();
    return shared;
  };
  /** Advances time as a timer would. */
  const runUntil = (endMs: number) => {
    while (sender.nextDueMs !== null && sender.nextDueMs <= endMs) {
      nowMs = Math.max(nowMs, sender.nextDueMs);
      sender.pump();
    }
    nowMs = endMs;
  };
  return { transport, sender, recycled, share, send, runUntil };
}

describe('StreamSender', () => {
  it('sends every packet of a frame once, in order and evenly, with the last one marked and cut to length', () => {
    const { transport, sender, runUntil, send } = stage();
    const shared = send(frame(1510, 2000));
    runUntil(1000);
    expect(transport.sent.map((packet) => packet.first)).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
    expect(transport.sent.map((packet) => packet.bytes)).toEqual(
      Array.from({ length: 11 }, (_, i) => (i < 10 ? 1244 : 16 + 80 + 28)),
    );
    expect(transport.sent.map((packet) => packet.marker)).toEqual([...Array<boolean>(10).fill(false), true]);
    expect(transport.sent.every((packet) => packet.timestamp === 96_000)).toBe(true);
    const span = (transport.sent.at(-1) as Sent).atMs;
    const bits = shared.bytes * 8;
    // Between the target and 1.25 times the target.
    expect(bits / (span / 1000)).toBeGreaterThan(10e6);
    expect((bits * 10) / 11 / (span / 1000)).toBeLessThan(12.5e6);
    expect(sender.counters).toMatchObject({
      framesSent: 1,
      packetsSent: 11,
      bytesSent: shared.bytes,
      pointsSent: 1510,
    });
  });

  it('returns a buffer once, after its last holder has released it', () => {
    const a = stage();
    const b = stage();
    const shared = a.share(frame(300));
    a.sender.enqueue(shared);
    b.sender.enqueue(shared);
    shared.release();
    a.runUntil(1000);
    expect(a.recycled).toHaveLength(0);
    b.runUntil(1000);
    expect(a.recycled).toEqual([shared.frame.buffer]);
  });

  it('drops the older of two queued frames, reports it, and returns its buffer', () => {
    const { sender, recycled, share, runUntil } = stage(1e6);
    const dropped: [OutgoingFrame, string][] = [];
    sender.onFrameDropped = (shared, reason) => dropped.push([shared, reason]);
    const frames = [share(frame(1500)), share(frame(1500)), share(frame(1500))] as const;
    sender.enqueue(frames[0]);
    runUntil(1);
    sender.enqueue(frames[1]);
    sender.enqueue(frames[2]);
    for (const shared of frames) shared.release();
    expect(dropped).toEqual([[frames[1], 'superseded']]);
    expect(recycled).toEqual([frames[1].frame.buffer]);
    runUntil(10_000);
    expect(sender.counters.framesSent).toBe(2);
    expect(recycled).toHaveLength(3);
  });

  it('knows when a frame has left, also one that is cut short, and of none that has not', () => {
    const { sender, share, runUntil, transport } = stage(1e6);
    const departures: unknown[] = [];
    const note = (sent: OutgoingFrame) => departures.push(sender.departureOf(sent));
    sender.onFrameSent = ({ frame: sent }) => note(sent);
    sender.onFrameDropped = note;
    const frames = [share(frame(1500)), share(frame(1500)), share(frame(1500))] as const;
    for (const shared of frames) {
      sender.enqueue(shared);
      shared.release();
      if (shared === frames[0]) runUntil(20);
    }
    expect(departures).toEqual([null]);
    runUntil(10_000);
    const at = (i: number) => transport.sent[i]?.atMs;
    expect(departures.slice(1)).toEqual([
      { firstMs: at(0), lastMs: at(9) },
      { firstMs: at(10), lastMs: at(19) },
    ]);
    expect(at(9)).toBeGreaterThan(20);
  });

  it('clears the queue when the stream stops', () => {
    const { transport, sender, recycled, runUntil, send } = stage(1e6);
    send(frame(1500));
    runUntil(20);
    const before = transport.sent.length;
    expect(before).toBeGreaterThan(0);
    sender.clear();
    runUntil(10_000);
    expect(transport.sent.length).toBe(before);
    expect(recycled).toHaveLength(1);
    expect(sender.nextDueMs).toBeNull();
  });

  it('loses packets but survives while the path is closed', () => {
    const { transport, sender, recycled, runUntil, send } = stage();
    transport.ready = false;
    send(frame(300));
    runUntil(1000);
    expect(sender.counters).toMatchObject({ packetsSent: 0, packetsUnsent: 2 });
    expect(recycled).toHaveLength(1);
  });

  it('ignores an empty frame', () => {
    const { sender, recycled, send } = stage();
    send(frame(0));
    expect(sender.nextDueMs).toBeNull();
    expect(recycled).toHaveLength(1);
  });

  it('passes transport feedback to the controller, and survives malformed feedback', () => {
    const { transport, sender, runUntil, send } = stage(1e6);
    send(frame(15_000));
    runUntil(1300);
    // Reports packets 0–39 as lost: 40 packets, run-length chunk "not received".
    const feedback = Buffer.alloc(24);
    feedback.writeUInt8(0x8f, 0);
    feedback.writeUInt8(205, 1);
    feedback.writeUInt16BE(5, 2);
    feedback.writeUInt16BE(0, 12);
    feedback.writeUInt16BE(40, 14);
    feedback.writeUInt16BE(40, 20);
    transport.onRtcp?.(feedback);
    expect(sender.counters.feedbackMessages).toBe(1);
    expect(sender.heardMs).toBe(1300);
    // All packets of the interval were lost: the rate halves, but not below its floor.
    runUntil(2500);
    sender.update();
    transport.onRtcp?.(feedback.subarray(0, 22));
    transport.onRtcp?.(Uint8Array.of(1));
    const truncated = Buffer.from(feedback);
    truncated.writeUInt16BE(9999, 14);
    transport.onRtcp?.(truncated);
    expect(sender.counters).toMatchObject({ feedbackMessages: 1, feedbackMalformed: 3 });
  });

  it('stops while too much is in flight, and continues when that has changed', () => {
    const controller = new ScriptedController(10e6);
    controller.wanted.congestionWindowBytes = 5000;
    const { transport, sender, runUntil, send } = stage(10e6, controller);
    send(frame(3000));
    runUntil(100);
    expect(controller.inFlight).toBeGreaterThanOrEqual(5000);
    expect(transport.sent.length).toBeLessThan(7);
    expect(sender.nextDueMs).toBeNull();
    controller.wanted.congestionWindowBytes = 1e6;
    runUntil(1000);
    expect(transport.sent).toHaveLength(20);
  });

  it('sends a probe train once, at the requested rate, in a frame that is large enough', () => {
    const controller = new ScriptedController(1e6);
    controller.wanted.probe = { clusterId: 7, bitsPerSecond: 10e6, bytes: 10_000 };
    const { transport, sender, runUntil, send } = stage(1e6, controller);
    send(frame(150));
    runUntil(100);
    expect(controller.clusters).toEqual([0]);
    expect(sender.probeWish?.clusterId).toBe(7);

    send(frame(3000));
    expect(sender.probeWish).toBeNull();
    runUntil(1000);
    const train = controller.clusters.flatMap((cluster, i) =>
      cluster === 7 ? [transport.sent[i] as Sent] : [],
    );
    expect(train).toHaveLength(8);
    const bits = train.slice(1).reduce((sum, { bytes }) => sum + (bytes + 68) * 8, 0);
    const seconds = ((train.at(-1) as Sent).atMs - (train[0] as Sent).atMs) / 1000;
    expect(bits / seconds).toBeGreaterThan(8e6);
    expect(bits / seconds).toBeLessThan(13e6);
    // The rest is sent at the normal rate.
    expect((transport.sent.at(-1) as Sent).atMs - (train.at(-1) as Sent).atMs).toBeGreaterThan(90);
  });

  it('drops the farthest points of a frame that takes too long', () => {
    const { transport, sender, runUntil, send } = stage(1e6);
    const dropped: string[] = [];
    sender.onFrameDropped = (_, reason) => dropped.push(reason);
    send({ ...frame(15_000), intervalMs: 40 });
    for (const atMs of [40, 80]) {
      runUntil(atMs);
      send({ ...frame(150), intervalMs: 40 });
    }
    expect(dropped).toEqual(['superseded', 'overdue'].toSorted());
    runUntil(200);
    expect(transport.sent.at(-1)?.marker).toBe(true);
  });

  it('retransmits what the receiver is missing, within limits', () => {
    const { transport, sender, runUntil } = stage();
    const nack = (pid: number, blp: number) => {
      const bytes = Buffer.alloc(16);
      bytes.writeUInt8(0x81, 0);
      bytes.writeUInt8(205, 1);
      bytes.writeUInt16BE(3, 2);
      bytes.writeUInt32BE(1, 8);
      bytes.writeUInt16BE(pid, 12);
      bytes.writeUInt16BE(blp, 14);
      return bytes;
    };
    transport.onRtcp?.(nack(7, 0b11));
    expect(transport.resent).toEqual([7, 8, 9]);
    // One of them was too old.
    expect(sender.counters).toMatchObject({ packetsResent: 2, bytesSent: 2600, packetsSent: 0 });
    for (let i = 0; i < 10; i++) transport.onRtcp?.(nack(i * 100, 0xffff));
    expect(transport.resent).toHaveLength(50);
    runUntil(1000);
    transport.onRtcp?.(nack(3000, 0));
    expect(transport.resent).toHaveLength(51);
    transport.onRtcp?.(nack(1, 1).subarray(0, 12));
    expect(sender.counters.feedbackMalformed).toBe(1);
  });

  describe('receiver reports', () => {
    const block = '00000001 05000003 000000c7 0000005a 00000000 00000000';
    const report = Buffer.from(`81c90007 00000009 ${block}`.replaceAll(' ', ''), 'hex');
    const sums = { packetsReceived: 97, packetsLost: 3, source: 'rtcp', rttMs: 40 };
    // 10 Mbit/s of stream 1.
    const remb = Buffer.from('8fce000500000009000000005245 4d42 0121312d00000001'.replaceAll(' ', ''), 'hex');

    it('count only if the operator gives no transport-wide feedback', () => {
      const controller = new ReportedController({ bitsPerSecond: 10e6 });
      const { transport, sender } = stage(10e6, controller);
      transport.onRtcp?.(report);
      transport.onRtcp?.(remb);
      expect(controller.told).toEqual([]);
      transport.transportFeedback = false;
      let changes = 0;
      sender.onRateChanged = () => changes++;
      transport.onRtcp?.(report);
      transport.onRtcp?.(remb);
      expect(controller.told).toEqual([sums, 0x1312d * 2 ** 8]);
      expect(changes).toBe(2);
      sender.onReceiverLimit(1e6);
      expect(controller.told.at(-1)).toBe(1e6);
    });

    it('give way to the operator’s own counts, except for the round trip', () => {
      const controller = new ReportedController({ bitsPerSecond: 10e6 });
      const { transport, sender, runUntil } = stage(10e6, controller);
      transport.transportFeedback = false;
      transport.onRtcp?.(report);
      sender.onReceiverReport({ packetsReceived: 50, packetsLost: 1 });
      sender.onReceiverReport({ packetsReceived: 60, packetsLost: 1 });
      transport.onRtcp?.(report);
      const own = { packetsLost: 1, source: 'application' };
      expect(controller.told).toEqual([
        sums,
        { ...own, packetsReceived: 50, rttMs: 40 },
        { ...own, packetsReceived: 60, rttMs: null },
      ]);
      runUntil(3001);
      transport.onRtcp?.(report);
      expect(controller.told).toHaveLength(4);
    });

    it('are counted if they are truncated', () => {
      const { transport, sender } = stage();
      transport.transportFeedback = false;
      const lies = Buffer.from(report);
      lies[0] = 0x82;
      transport.onRtcp?.(lies);
      expect(sender.counters.feedbackMalformed).toBe(1);
    });
  });
});
