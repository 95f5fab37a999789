import { decodeJson, operatorControlCodec } from '@farpoint/protocol';
import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';
import { knownInMemory } from '../access/known-robots.ts';
import { StrangeRobotError } from '../access/session-admission.ts';
import type { IntroducedPeerEvents, IntroducedPeerOptions, LinkPeer } from './introduced-peer.ts';
import type { RobotLinkEvents } from './robot-link.ts';
import { WebRtcLink } from './webrtc-link.ts';

/** The signaling service's end of the page's WebSocket. */
class Line {
  static readonly OPEN = 1;
  static opened: Line[] = [];
  readyState = 0;
  onopen: (() => void) | null = null;
  onclose: (() => void) | null = null;
  onmessage: ((event: { data: string }) => void) | null = null;
  readonly said: { type: string; session?: string }[] = [];

  constructor() {
    Line.opened.push(this);
  }

  send(text: string): void {
    this.said.push(JSON.parse(text));
  }

  close(): void {
    this.readyState = 3;
  }

  /** The service answers: robot-1 is there. */
  welcome(): this {
    this.readyState = Line.OPEN;
    this.onopen?.();
    this.tell({ type: 'operator.welcome', iceServers: [{ urls: 'stun:a' }] });
    this.tell({ type: 'robots', robots: [{ id: 'robot-1', name: 'R' }] });
    return this;
  }

  tell(message: object): void {
    this.onmessage?.({ data: JSON.stringify(message) });
  }
}

/** A peer connection that only records what it is told. */
class Peer {
  readonly options: IntroducedPeerOptions;
  readonly events: IntroducedPeerEvents;
  readonly told: string[] = [];
  readonly controls: string[] = [];
  isClosed = false;

  constructor(options: IntroducedPeerOptions, events: IntroducedPeerEvents) {
    this.options = options;
    this.events = events;
  }

  useIceServers(): void {}
  sendBandwidth(): void {}
  offer({ sdp }: { sdp: string }): void {
    this.told.push(`offer ${sdp}`);
  }
  candidate({ candidate }: { candidate: string }): void {
    this.told.push(`candidate ${candidate}`);
  }
  sendSession(text: string): void {
    this.told.push(text);
  }
  sendControl(text: string): void {
    this.controls.push(decodeJson(operatorControlCodec, text).type);
  }
  close(): void {
    this.isClosed = true;
  }
}

const windowed = new EventTarget();
const browser = Object.assign(new EventTarget(), { onLine: true });
beforeEach(() => {
  vi.useFakeTimers();
  vi.spyOn(console, 'warn').mockImplementation(() => undefined);
  Line.opened = [];
  vi.stubGlobal('WebSocket', Line);
  vi.stubGlobal('window', windowed);
  vi.stubGlobal('navigator', browser);
});
afterEach(() => {
  vi.unstubAllGlobals();
  vi.restoreAllMocks();
  vi.useRealTimers();
});

function setUp() {
  const peers: Peer[] = [];
  const heard: [string, ...unknown[]][] = [];
  const events = new Proxy({} as RobotLinkEvents, {
    get:
      (_, name: string) =>
      (...given: unknown[]) =>
        void heard.push([name, ...given]),
  });
  const link = new WebRtcLink(
    {
      signalingUrl: 'ws://127.0.0.1:1',
      name: 'Ada',
      token: undefined,
      knownRobots: knownInMemory(),
      worker: {} as Worker,
      transform: 'none',
      icePolicy: 'all',
    },
    events,
    (options, peerEvents) => {
      const peer = new Peer(options, peerEvents);
      peers.push(peer);
      return peer as unknown as LinkPeer;
    },
  );
  link.start();
  const line = () => Line.opened.at(-1) as Line;
  return {
    link,
    peers,
    heard: (name: string) => heard.filter(([each]) => each === name).map(([, ...given]) => given),
    line,
    /** Up to a session that is live. */
    live: (session = 'session-1') => {
      line().welcome();
      link.connect('robot-1');
      line().tell({ type: 'session.opened', session, robotId: 'robot-1' });
      peers.at(-1)?.events.onConnected();
      return peers.at(-1) as Peer;
    },
  };
}

describe('a session with a robot', () => {
  test('is asked for when the robot is listed, and is live when its connection is there', () => {
    const { link, line, peers, heard } = setUp();
    link.connect('robot-1');
    expect([link.phase, link.signaling]).toEqual(['waiting', 'connecting']);
    line().welcome();
    expect([link.phase, line().said.at(-1)]).toEqual([
      'opening',
      { type: 'session.open', robotId: 'robot-1' },
    ]);
    line().tell({ type: 'session.opened', session: 'session-1', robotId: 'robot-1' });
    expect(peers[0]?.options).toMatchObject({
      session: 'session-1',
      robotId: 'robot-1',
      generation: 1,
      iceServers: [{ urls: 'stun:a' }],
    });
    peers[0]?.events.onConnected();
    expect([link.phase, heard('onGeneration')]).toEqual(['live', [[1]]]);
  });

  test('that nobody wants any more is closed, and makes no connection', () => {
    const { link, line, peers } = setUp();
    line().welcome();
    link.connect('robot-1');
    link.disconnect();
    line().tell({ type: 'session.opened', session: 'session-1', robotId: 'robot-1' });
    expect(peers).toEqual([]);
    expect(line().said.at(-1)).toEqual({ type: 'session.close', session: 'session-1' });
  });

  test('takes offers and candidates of its own only', () => {
    const { line, live } = setUp();
    const peer = live();
    for (const session of ['session-1', 'session-2']) {
      line().tell({ type: 'session.offer', session, sdp: `sdp of ${session}` });
      const candidate = { candidate: `candidate of ${session}`, sdpMid: '0', sdpMLineIndex: 0 };
      line().tell({ type: 'session.candidate', session, candidate });
    }
    expect(peer.told).toEqual(['offer sdp of session-1', 'candidate candidate of session-1']);
  });

  test('hears nothing from the connection of the one before', () => {
    const { link, line, peers, live, heard } = setUp();
    const before = live();
    line().tell({ type: 'session.closed', session: 'session-1', reason: 'silent' });
    expect(before.isClosed).toBe(true);
    vi.advanceTimersByTime(20_000);
    line().tell({ type: 'session.opened', session: 'session-2', robotId: 'robot-1' });
    expect(peers).toHaveLength(2);
    const sends = () => heard('onTelemetry').length + heard('onEstop').length;
    const counted = sends();
    before.events.onMessage('session', JSON.stringify({ type: 'estop', latched: true }));
    before.events.onFailed('late');
    expect([sends(), link.phase]).toEqual([counted, 'opening']);
    peers[1]?.events.onMessage('session', JSON.stringify({ type: 'estop', latched: true }));
    expect(sends()).toBe(counted + 1);
  });

  test('of a full robot says how many it takes', () => {
    const { link, line } = setUp();
    line().welcome();
    link.connect('robot-1');
    line().tell({ type: 'session.opened', session: 'session-1', robotId: 'robot-1' });
    line().tell({ type: 'session.closed', session: 'session-1', reason: 'robot-full', maxOperators: 4 });
    expect([link.maxOperators, link.lastLoss]).toEqual([4, 'robot-full']);
  });

  test('is not ended by somebody who offers in the robot’s place, but an attempt is', () => {
    const { link, line, peers, live } = setUp();
    const stranger = new StrangeRobotError('robot-unproven', 'no proof', null);
    const peer = live();
    peer.events.onStranger(stranger);
    expect([link.phase, peer.isClosed]).toEqual(['live', false]);
    line().tell({ type: 'session.closed', session: 'session-1', reason: 'silent' });
    vi.advanceTimersByTime(20_000);
    line().tell({ type: 'session.opened', session: 'session-2', robotId: 'robot-1' });
    peers[1]?.events.onStranger(stranger);
    expect([link.lastLoss, link.lossDetail, peers[1]?.isClosed]).toEqual([
      'robot-unproven',
      'no proof',
      true,
    ]);
  });
});

test('reports are of the session that runs', () => {
  const { link, live } = setUp();
  const peer = live();
  const counts = { packetsReceived: 10, packetsLost: 1, bytesReceived: 1000, drops: {}, decodeUs: 0 };
  link.sendReport({ type: 'report', generation: 0, ...counts } as unknown as Parameters<
    typeof link.sendReport
  >[0]);
  expect(peer.controls).not.toContain('receiverReport');
  link.sendReport({ type: 'report', generation: 1, ...counts } as unknown as Parameters<
    typeof link.sendReport
  >[0]);
  expect(peer.controls.filter((type) => type === 'receiverReport')).toHaveLength(1);
});

test('asks for the robot’s clock about twice a second while the session is live', () => {
  const { live } = setUp();
  const peer = live();
  vi.advanceTimersByTime(2000);
  expect(peer.controls.filter((type) => type === 'clockProbe')).toHaveLength(3);
});

test('a page that is left ends its session at once, and one that is restored takes it up again', () => {
  const { link, line, live } = setUp();
  const peer = live();
  const { said } = line();
  windowed.dispatchEvent(new Event('pagehide'));
  expect([said.at(-1), peer.isClosed, link.signaling]).toEqual([
    { type: 'session.close', session: 'session-1' },
    true,
    'stopped',
  ]);
  windowed.dispatchEvent(Object.assign(new Event('pageshow'), { persisted: true }));
  line().welcome();
  expect(line().said.at(-1)).toEqual({ type: 'session.open', robotId: 'robot-1' });
});

test('a link that is closed listens to nothing any more', () => {
  const { link, line, live } = setUp();
  const peer = live();
  link.close();
  expect([peer.isClosed, line().said.at(-1)]).toEqual([
    true,
    { type: 'session.close', session: 'session-1' },
  ]);
  const before = Line.opened.length;
  windowed.dispatchEvent(Object.assign(new Event('pageshow'), { persisted: true }));
  browser.dispatchEvent(new Event('online'));
  vi.advanceTimersByTime(60_000);
  expect([Line.opened.length, link.phase]).toEqual([before, 'none']);
});
