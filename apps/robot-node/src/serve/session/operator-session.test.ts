import { FixedRateController } from '@farpoint/congestion';
import { decodeJson, type RobotSessionMessage, robotSessionCodec } from '@farpoint/protocol';
import { MotionSupervisor } from '@farpoint/safety';
import { makeGuard } from '@farpoint/safety/testing';
import { describe, expect, it, onTestFinished, vi } from 'vitest';
import { DriveStation } from '../../motion/drive/drive-station.ts';
import type { OperatorPeer } from '../../send/transport/operator-peer.ts';
import type { OperatorPeerEvents } from '../../send/transport/peer-events.ts';
import type { SendLoop } from '../../send/transport/send-loop.ts';
import { SharedFrame } from '../../send/transport/shared-frame.ts';
import { frame, RecordingTransport } from '../../send/transport/testing/recording-transport.ts';
import type { SessionHost } from './operator-messages.ts';
import { OperatorSession, type OperatorSessionEvents } from './operator-session.ts';

const CLAIM = { priority: 0, weight: 1, usefulBitsPerSecond: 1e9 };

/** A session whose connection is the test, on a clock that the test advances. */
function setUp() {
  let nowMs = 1000;
  const inbox: RobotSessionMessage[] = [];
  const guard = makeGuard();
  const sentViews = vi.spyOn(guard.sentViews, 'sent');
  const drive = new DriveStation(
    new MotionSupervisor(guard),
    () => undefined,
    () => nowMs,
  );
  onTestFinished(() => drive.close());
  const host = { drive, now: () => nowMs, messageRefused: vi.fn() } as unknown as SessionHost;
  const senders = new Set<unknown>();
  const sendLoop = {
    add: (sender: unknown) => void senders.add(sender),
    remove: (sender: unknown) => void senders.delete(sender),
    run: vi.fn(),
  };
  const events = {
    onCandidate: vi.fn(),
    onCandidateRefused: vi.fn(),
    onConnected: vi.fn(),
    onCloudFormats: vi.fn(),
    onNeedsKeyFrame: vi.fn(),
    onLatencyFrameLost: vi.fn(),
    onEnded: vi.fn(),
  } satisfies OperatorSessionEvents;
  const update = vi.fn();
  let peer: OperatorPeerEvents | null = null;
  const session = new OperatorSession(
    {
      session: 'session-1',
      operatorName: 'Ada',
      peer: { iceServers: [], connectTimeoutMs: 1000 },
      openPeer: (_options, peerEvents) => {
        peer = peerEvents;
        const made = {
          sendSession: (text: string) => inbox.push(decodeJson(robotSessionCodec, text)),
          sendPicture: () => true,
          heardSinceLast: () => false,
          messageBytesSent: 0,
        };
        return made as unknown as OperatorPeer;
      },
      makeController: () => new FixedRateController({ bitsPerSecond: 10e6 }),
      pictureShare: 0,
      claims: () => [CLAIM, CLAIM],
      budgets: { update },
      mostVideoBitsPerSecond: () => 0,
    },
    host,
    sendLoop as unknown as SendLoop,
    events,
  );
  const transport = new RecordingTransport(() => nowMs);
  const connection = () => peer as unknown as OperatorPeerEvents;
  let recycled = 0;
  return {
    session,
    events,
    inbox,
    transport,
    senders,
    sentViews,
    update,
    connection,
    recycled: () => recycled,
    connect: () => connection().onConnected(transport, [], null),
    say: (message: object) => connection().onMessage('session', JSON.stringify(message)),
    offer: (more: object = {}) => {
      const shared = new SharedFrame({ ...frame(150, nowMs), ...more }, 68, () => void recycled++);
      session.enqueue(shared);
      shared.release();
      session.update();
    },
    wait: (ms: number) => {
      nowMs += ms;
      session.sender?.pump();
    },
  };
}

describe('a session with an operator', () => {
  it('tells when each frame passed the robot’s stations', () => {
    const { connect, offer, wait, session } = setUp();
    connect();
    offer({ frameNumber: 9, sensor: 1, capturedAtMs: 960, inMemoryMs: 964, readyMs: 991.5 });
    wait(5);
    expect(session.messages.stages.due(2000, false)).toEqual({
      type: 'stages',
      frames: [[1, 9, 960_000, 4000, 31_500, 45_000, 45_000]],
      commands: [],
    });
  });

  it('takes and sends nothing before its connection is there', () => {
    const { session, offer, recycled, transport, events } = setUp();
    offer();
    expect([session.streaming, session.cloudBitsPerSecond(0), recycled(), transport.sent]).toEqual([
      false,
      0,
      1,
      [],
    ]);
    expect(events.onConnected).not.toHaveBeenCalled();
  });

  it('streams what its operator wants while the connection is there, and ends with it', () => {
    const { session, connect, connection, offer, wait, transport, senders, events, recycled } = setUp();
    connect();
    expect(events.onConnected).toHaveBeenCalledTimes(1);
    expect([session.streaming, senders.has(session.sender), session.cloudBitsPerSecond(0) > 9e6]).toEqual([
      true,
      true,
      true,
    ]);
    offer();
    wait(50);
    expect([transport.sent.length, recycled()]).toEqual([1, 1]);
    connection().onEnded('connection-lost', 'gone');
    expect([session.streaming, session.sender, senders.size, session.cloudBitsPerSecond(0)]).toEqual([
      false,
      null,
      0,
      0,
    ]);
    expect(events.onEnded).toHaveBeenCalledWith('connection-lost', 'gone');
  });

  it('sends nothing to an operator that is not heard, or that has paused the stream', () => {
    const { session, connect, say, offer, wait, transport, update } = setUp();
    connect();
    session.quiet = true;
    offer();
    wait(50);
    expect(transport.sent).toEqual([]);
    session.quiet = false;
    update.mockClear();
    say({ type: 'stream', running: false });
    expect([session.streaming, update.mock.calls.length]).toEqual([false, 1]);
    offer();
    wait(50);
    expect(transport.sent).toEqual([]);
    say({ type: 'stream', running: true });
    offer();
    wait(50);
    expect(transport.sent).toHaveLength(1);
  });

  it('wants the sensors, and reads the formats, that its operator names, and gets their headers', () => {
    const { session, connect, say, events, inbox } = setUp();
    connect();
    expect([session.wants(0), session.wants(1), session.reads('organised')]).toEqual([true, false, false]);
    say({ type: 'sensors', sensors: [1] });
    say({ type: 'cloudFormats', formats: ['points64', 'organised'] });
    expect(events.onCloudFormats).toHaveBeenCalledTimes(2);
    expect([session.wants(0), session.wants(1), session.reads('organised')]).toEqual([false, true, true]);
    expect([session.cloudBitsPerSecond(0), session.probesWith(1)]).toEqual([0, true]);
    session.announce({ format: 'organised', header: new Uint8Array([1, 2, 3]) }, 1);
    expect(inbox).toEqual([{ type: 'cloudStream', format: 'organised', header: 'AQID', sensor: 1 }]);
  });

  it('skips the clouds that its operator’s computer does not draw, but no green one', () => {
    const { session, connect, say, offer, wait, transport } = setUp();
    connect();
    say({ type: 'display', framesPerSecond: 10, points: 1e6 });
    expect(session.display).toEqual({ framesPerSecond: 10, points: 1e6 });
    for (let i = 0; i < 30; i++) {
      offer();
      wait(10);
    }
    expect(transport.sent.length).toBeLessThanOrEqual(4);
    const before = transport.sent.length;
    offer({ latencyTest: true });
    wait(10);
    expect(transport.sent).toHaveLength(before + 1);
  });

  it('tells the guard of each view that its operator may see from now on', () => {
    const { connect, offer, sentViews } = setUp();
    offer();
    expect(sentViews).not.toHaveBeenCalled();
    connect();
    offer({ capturedAtMs: 990 });
    expect(sentViews).toHaveBeenCalledWith('session-1', 990, 0);
  });

  it('divides its path anew when the operator limits it', () => {
    const { session, connect, connection, update } = setUp();
    connect();
    update.mockClear();
    const limit = new Uint8Array(new Int32Array([1_000_000]).buffer);
    connection().onMessage('bandwidth', limit);
    expect(update).toHaveBeenCalled();
    expect(session.cloudBitsPerSecond(0)).toBeGreaterThan(0);
  });
});

describe('a latency test', () => {
  it('is answered once, by the next green frame', () => {
    const { session, connect, offer, inbox } = setUp();
    connect();
    expect(session.askLatencyTest({ id: 7, commandMs: 900 })).toBe(true);
    expect(session.askLatencyTest({ id: 7, commandMs: 905 })).toBe(false);
    offer();
    expect(inbox).toEqual([]);
    offer({ latencyTest: true, frameNumber: 12, capturedAtMs: 995 });
    offer({ latencyTest: true, frameNumber: 13 });
    expect(inbox).toEqual([
      { type: 'latencyFrame', id: 7, frameNumber: 12, points: 150, commandMs: 900, captureMs: 995 },
    ]);
  });

  it('asks for another green frame if the first is dropped before it is sent', () => {
    const { session, connect, offer, transport, events, wait } = setUp();
    connect();
    transport.ready = false;
    session.askLatencyTest({ id: 7, commandMs: 900 });
    offer({ latencyTest: true });
    for (let i = 0; i < 5; i++) {
      offer();
      wait(1000);
    }
    expect(events.onLatencyFrameLost).toHaveBeenCalled();
  });
});
