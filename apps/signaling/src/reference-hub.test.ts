import { describe, expect, test } from 'vitest';
import { ReferenceHub } from './reference-hub.ts';
import { FakeClient, FakeClock, type Json, RecordingObserver } from './test-support.ts';

function setup() {
  const clock = new FakeClock();
  const observer = new RecordingObserver();
  const hub = new ReferenceHub({
    clock,
    observer,
    limits: {
      maxMessageBytes: 4096,
      messagesPerSecond: 10,
      relayBytesPerSecond: 1e6,
      relayMessagesPerSecond: 1000,
      messageBurst: 20,
      maxFaults: 5,
      maxRobots: 3,
      maxCandidatesPerRobot: 4,
    },
  });
  const client = () => new FakeClient((peer) => hub.client(peer));
  const socket = () => new FakeClient((peer) => hub.robot(peer));
  const robot = (name = 'Diane') => {
    const made = socket();
    made.send({ type: 'register', name, sdpOffer: `offer of ${name}` });
    return made;
  };
  return { hub, observer, client, robot, socket };
}

const record = (id: number, more: Json = {}): Json => ({
  id,
  name: 'Diane',
  sdpOffer: 'offer of Diane',
  sdpAnswer: null,
  robotCandidates: [],
  clientCandidates: [],
  ...more,
});

describe('the message sequence', () => {
  test('register: ids count from 0, and clients are told', () => {
    const { client, robot } = setup();
    const c = client();
    const [first, second] = [robot(), robot('Elle')];
    expect(first.take()).toEqual([{ type: 'registered', robotId: 0 }]);
    expect(second.take()).toEqual([{ type: 'registered', robotId: 1 }]);
    expect(c.take()).toEqual([
      { type: 'register', robot: record(0) },
      { type: 'register', robot: record(1, { name: 'Elle', sdpOffer: 'offer of Elle' }) },
    ]);
  });

  test('robot 0: offer and candidates reach every client, answer and candidates of each client reach it', () => {
    const { client, robot } = setup();
    const r = robot();
    const clients = [client(), client()];
    r.take();
    r.send({ type: 'candidate', robotId: 0, candidate: 'candidate:1' });
    r.send({ type: 'offer', robotId: 0, sdpOffer: 'again' });
    for (const c of clients) {
      expect(c.take()).toEqual([
        { type: 'candidate', robotId: 0, candidate: 'candidate:1' },
        { type: 'offer', robotId: 0, sdpOffer: 'again' },
      ]);
      c.send({ type: 'answer', robotId: 0, sdpAnswer: 'yes' });
      c.send({ type: 'candidate', robotId: 0, candidate: 'candidate:2' });
      expect(r.take()).toEqual([
        { type: 'sdpAnswer', sdpAnswer: 'yes' },
        { type: 'candidate', candidate: 'candidate:2' },
      ]);
    }
  });

  test('getRobots: a late client gets the offer, the answer and all candidates so far', () => {
    const { client, robot } = setup();
    const r = robot();
    const early = client();
    r.send({ type: 'candidate', robotId: 0, candidate: 'r1' });
    early.send({ type: 'answer', robotId: 0, sdpAnswer: 'yes' });
    early.send({ type: 'candidate', robotId: 0, candidate: 'c1' });
    const late = client();
    late.send({ type: 'getRobots' });
    expect(late.take()).toEqual([
      {
        type: 'robots',
        robots: [record(0, { sdpAnswer: 'yes', robotCandidates: ['r1'], clientCandidates: ['c1'] })],
      },
    ]);
  });

  test('a new offer counts as unanswered', () => {
    const { client, robot } = setup();
    const r = robot();
    const c = client();
    c.send({ type: 'answer', robotId: 0, sdpAnswer: 'yes' });
    r.send({ type: 'offer', robotId: 0, sdpOffer: 'again' });
    c.take();
    c.send({ type: 'getRobots' });
    expect(c.take()).toEqual([{ type: 'robots', robots: [record(0, { sdpOffer: 'again' })] }]);
  });

  test('deregister sends both messages, with the id; a closed socket sends deregistered', () => {
    const { client, robot } = setup();
    const [first, second] = [robot(), robot()];
    const c = client();
    first.send({ type: 'deregister', robotId: 0 });
    expect(c.take()).toEqual([
      { type: 'deregister', robotId: 0 },
      { type: 'deregistered', robotId: 0 },
    ]);
    first.connection.closed();
    expect(c.take()).toEqual([]);
    second.connection.closed();
    expect(c.take()).toEqual([{ type: 'deregistered', robotId: 1 }]);
    c.send({ type: 'getRobots' });
    expect(c.take()).toEqual([{ type: 'robots', robots: [] }]);
  });

  test('a robot that restarts gets a new id, and so does one that registers again', () => {
    const { client, robot } = setup();
    const c = client();
    robot().connection.closed();
    const r = robot();
    c.take();
    r.take();
    r.send({ type: 'register', name: 'Diane', sdpOffer: 'offer of Diane' });
    expect(r.take()).toEqual([{ type: 'registered', robotId: 2 }]);
    expect(c.take()).toEqual([
      { type: 'deregistered', robotId: 1 },
      { type: 'register', robot: record(2) },
    ]);
    r.send({ type: 'offer', robotId: 1, sdpOffer: 'old' });
    expect(c.take()).toEqual([]);
  });

  test('a robot may register without an offer', () => {
    const { client, socket } = setup();
    const c = client();
    socket().send({ type: 'register', name: 'Diane' });
    expect(c.take()).toEqual([{ type: 'register', robot: record(0, { sdpOffer: null }) }]);
  });

  test('JSON in binary messages is accepted, too', () => {
    const { client, robot } = setup();
    robot();
    const c = client();
    c.connection.receive(new TextEncoder().encode('{"type":"getRobots"}'));
    expect(c.take()).toHaveLength(1);
  });
});

describe('a peer cannot speak for another robot', () => {
  test.each([
    { type: 'offer', robotId: 0, sdpOffer: 'evil' },
    { type: 'candidate', robotId: 0, candidate: 'evil' },
    { type: 'deregister', robotId: 0 },
  ])('$type', (message) => {
    const { client, robot, socket, observer } = setup();
    robot();
    const [other, stranger, c] = [robot('Eve'), socket(), client()];
    other.send(message);
    stranger.send(message);
    expect(c.take()).toEqual([]);
    c.send({ type: 'getRobots' });
    expect((c.take()[0] as { robots: Json[] }).robots[0]).toEqual(record(0));
    expect(observer.rejects).toEqual(['reference-robot: not-yours', 'reference-robot: not-yours']);
  });

  test('clients cannot speak as robots', () => {
    const { client, robot } = setup();
    robot();
    const [c, other] = [client(), client()];
    c.send({ type: 'offer', robotId: 0, sdpOffer: 'evil' });
    c.send({ type: 'deregister', robotId: 0 });
    c.send({ type: 'register', name: 'x', sdpOffer: 'y' });
    expect(other.take()).toEqual([]);
  });
});

describe('limits', () => {
  test('candidates are buffered up to a limit; the oldest are dropped', () => {
    const { client, robot } = setup();
    const r = robot();
    for (let i = 0; i < 6; i++) r.send({ type: 'candidate', robotId: 0, candidate: `r${i}` });
    const c = client();
    c.send({ type: 'getRobots' });
    expect(c.take()).toEqual([
      { type: 'robots', robots: [record(0, { robotCandidates: ['r2', 'r3', 'r4', 'r5'] })] },
    ]);
  });

  test('the number of robots is limited', () => {
    const { robot } = setup();
    for (let i = 0; i < 3; i++) robot();
    const fourth = robot();
    expect(fourth.take()).toEqual([]);
    expect(fourth.peer.closed?.code).toBe(1013);
  });

  test('an answer to a robot that has left is dropped without harm', () => {
    const { client, observer } = setup();
    const c = client();
    c.send({ type: 'answer', robotId: 0, sdpAnswer: 'late' });
    expect([c.take(), c.peer.closed]).toEqual([[], null]);
    expect(observer.rejects).toEqual(['reference-client: unknown-robot']);
  });

  test('ignores an answer without an offer, and one to a registration that has ended', () => {
    const { client, socket, observer } = setup();
    const r = socket();
    const c = client();
    r.send({ type: 'register', name: 'Diane' });
    c.send({ type: 'answer', robotId: 0, sdpAnswer: 'to what?' });
    // It registers again on the same socket.
    r.send({ type: 'register', name: 'Diane', sdpOffer: 'offer of Diane' });
    r.take();
    c.take();
    c.send({ type: 'answer', robotId: 0, sdpAnswer: 'late' });
    c.send({ type: 'getRobots' });
    expect([r.take(), c.take()]).toEqual([[], [{ type: 'robots', robots: [record(1)] }]]);
    expect(observer.rejects).toEqual(['reference-client: no-offer', 'reference-client: unknown-robot']);
  });

  test.each([
    'nope',
    'null',
    '{}',
    '[]',
    '{"type":"register"}',
    '{"type":"offer","robotId":"0","sdpOffer":"x"}',
    '"\\ud800"',
  ])('%s harms nobody; many such and the socket is closed', (junk) => {
    const { client, robot } = setup();
    const [bad, badClient, r, c] = [robot(), client(), robot(), client()];
    for (let i = 0; i < 5; i++) {
      bad.connection.receive(junk);
      badClient.connection.receive(junk);
    }
    expect(bad.peer.closed?.code).toBe(1008);
    expect(badClient.peer.closed?.code).toBe(1008);
    r.send({ type: 'candidate', robotId: 1, candidate: 'fine' });
    expect(c.take()).toEqual([{ type: 'candidate', robotId: 1, candidate: 'fine' }]);
  });

  test('at shutdown, closes sockets with 1001', () => {
    const { client, robot } = setup();
    for (const one of [client(), robot()]) {
      one.connection.shutDown();
      expect(one.peer.closed?.code).toBe(1001);
    }
  });
});
