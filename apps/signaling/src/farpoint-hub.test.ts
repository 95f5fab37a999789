import { describe, expect, test } from 'vitest';
import { AccessList } from './access.ts';
import { FarpointHub } from './farpoint-hub.ts';
import { FakeClient, FakeClock, type Json, RecordingObserver } from './test-support.ts';

const limits = {
  maxMessageBytes: 4096,
  messagesPerSecond: 10,
  messageBurst: 20,
  relayBytesPerSecond: 1e6,
  relayMessagesPerSecond: 1000,
  maxFaults: 5,
  maxSessionsPerOperator: 2,
  maxSessionsPerRobot: 2,
  maxRobots: 3,
  helloTimeoutMs: 1000,
};

function setup(
  options: {
    robots?: AccessList;
    operators?: AccessList;
    revocations?: string[];
    signInUrl?: string;
    more?: Partial<typeof limits>;
  } = {},
) {
  const clock = new FakeClock();
  const observer = new RecordingObserver();
  let handles = 0;
  const hub = new FarpointHub({
    clock,
    observer,
    limits: { ...limits, ...options.more },
    listIntervalMs: 100,
    listBytesPerSecond: 1e9,
    access: () => ({
      robots: options.robots ?? new AccessList(null),
      operators: options.operators ?? new AccessList(null),
    }),
    iceServers: (name) => [{ urls: 'turn:turn.example', username: name, credential: 'c' }],
    revocations: () => options.revocations ?? [],
    makeHandle: () => `s${++handles}`,
    signInUrl: options.signInUrl ?? null,
  });
  const robot = (id: string, key = `key-${id}`, more: Json = {}): FakeClient => {
    const client = new FakeClient((peer) => hub.robot(peer));
    client.send({ type: 'robot.hello', protocol: 1, id, name: `Robot ${id}`, key, ...more });
    return client;
  };
  const operator = (name = 'Ada', more: Json = {}): FakeClient => {
    const client = new FakeClient((peer) => hub.operator(peer));
    client.send({ type: 'operator.hello', protocol: 1, name, ...more });
    return client;
  };
  /** A robot and an operator with a session, with all messages so far taken. */
  const session = (id = 'r1') => {
    const r = robot(id);
    const o = operator();
    o.send({ type: 'session.open', robotId: id });
    const handle = o.take().find((message) => message.type === 'session.opened')!.session as string;
    r.take();
    return { r, o, handle };
  };
  return { hub, clock, observer, robot, operator, session };
}

const closed = (session: string, reason: string) => ({ type: 'session.closed', session, reason });

describe('hello', () => {
  test('welcomes and lists a robot; welcomes an operator with the list', () => {
    const { robot, operator } = setup();
    const r = robot('r1');
    expect(r.take()).toEqual([
      {
        type: 'robot.welcome',
        id: 'r1',
        iceServers: [{ urls: 'turn:turn.example', username: 'r1', credential: 'c' }],
      },
    ]);
    const o = operator();
    expect(o.take()).toEqual([
      { type: 'operator.welcome', iceServers: [expect.objectContaining({ urls: 'turn:turn.example' })] },
      { type: 'robots', robots: [{ id: 'r1', name: 'Robot r1' }] },
    ]);
  });

  test('is followed by the lists of revoked grants, and by each that changes', () => {
    const revocations = ['a.b.c', 'd.e.f'];
    const { hub, robot, operator } = setup({ revocations });
    const [r, o] = [robot('r1'), operator()];
    expect(r.take().slice(1)).toEqual(revocations.map((list) => ({ type: 'revocations', list })));
    o.take();
    hub.tellRevocations('g.h.i');
    expect([r.take(), o.take()]).toEqual([[{ type: 'revocations', list: 'g.h.i' }], []]);
  });

  test('tells operators where they sign in', () => {
    const signInUrl = 'https://issuer.example/sign-in';
    expect(setup({ signInUrl }).operator().take()[0]).toMatchObject({ signIn: signInUrl });
  });

  test('must come first', () => {
    const { hub, observer } = setup();
    const client = new FakeClient((peer) => hub.operator(peer));
    client.send({ type: 'session.open', robotId: 'r1' });
    expect(client.types()).toEqual(['hello-first']);
    client.send({ type: 'operator.hello', protocol: 1, name: 'Ada' });
    expect(client.types()).toEqual(['operator.welcome', 'robots']);
    expect(observer.rejects).toEqual(['operator: hello-first']);
  });

  test('must come in time', () => {
    const { hub, clock } = setup();
    const client = new FakeClient((peer) => hub.robot(peer));
    clock.advance(999);
    expect(client.peer.closed).toBeNull();
    clock.advance(1);
    expect(client.types()).toEqual(['hello-first']);
    expect(client.peer.closed?.code).toBe(1008);
  });

  test('leaves no timer if it comes in time or the socket closes first', () => {
    const { hub, clock, robot } = setup();
    robot('r1');
    new FakeClient((peer) => hub.robot(peer)).connection.closed();
    clock.advance(0);
    expect(clock.pending).toBe(0);
  });

  test('is refused for another protocol version', () => {
    const { robot } = setup();
    const r = robot('r1', 'k', { protocol: 2 });
    expect(r.types()).toEqual(['unsupported-protocol']);
    expect(r.peer.closed?.code).toBe(1008);
  });

  test('must come only once', () => {
    const { robot } = setup();
    const r = robot('r1');
    r.take();
    r.send({ type: 'robot.hello', protocol: 1, id: 'r2', name: 'x', key: 'k' });
    expect(r.types()).toEqual(['malformed']);
  });

  test('replaces half a surrogate pair in a name by U+FFFD', () => {
    const { operator, robot } = setup();
    robot('r1', 'k', { name: 'a\ud800' });
    expect(operator().take()[1]).toEqual({ type: 'robots', robots: [{ id: 'r1', name: 'a\ufffd' }] });
  });
});

describe('robot ids', () => {
  test('another key cannot take the id of a live robot', () => {
    const { robot, session, observer } = setup();
    const { r, o, handle } = session('r1');
    const thief = robot('r1', 'other-key');
    expect(thief.types()).toEqual(['robot-id-taken']);
    expect(thief.peer.closed?.code).toBe(1008);
    thief.connection.closed();
    r.send({ type: 'session.offer', session: handle, sdp: 'v=0' });
    expect(o.types()).toEqual(['session.offer']);
    expect(observer.left).toEqual([]);
  });

  test('the same key takes over: the older socket is closed and its sessions end', () => {
    const { robot, session, clock, hub } = setup();
    const { r, o, handle } = session('r1');
    const newer = robot('r1');
    expect(newer.types()).toEqual(['robot.welcome']);
    expect(r.peer.closed?.code).toBe(1008);
    expect(o.take()).toEqual([closed(handle, 'robot-left')]);
    // The end of the older socket no longer changes anything.
    r.connection.closed();
    clock.advance(1000);
    expect(o.take()).toEqual([]);
    expect(hub.counts).toEqual({ robots: 1, operators: 1, sessions: 0 });
    o.send({ type: 'session.open', robotId: 'r1' });
    expect(newer.types()).toEqual(['session.request']);
  });

  test('an id is free again once its robot has left', () => {
    const { robot } = setup();
    robot('r1', 'a').connection.closed();
    expect(robot('r1', 'b').types()).toEqual(['robot.welcome']);
  });

  test('limits the number of robots, but lets a known one come back', () => {
    const { robot } = setup();
    for (const id of ['a', 'b', 'c']) robot(id);
    const d = robot('d');
    expect(d.types()).toEqual(['full']);
    expect(d.peer.closed?.code).toBe(1008);
    expect(robot('a').types()).toEqual(['robot.welcome']);
  });
});

describe('tokens', () => {
  const robots = new AccessList({ bound: new Map([['r1', ['token-of-r1']]]), free: ['any-robot'] });
  const operators = new AccessList({ bound: new Map(), free: ['operator-token'] });

  test.each([
    ['r1', 'token-of-r1', 'robot.welcome'],
    ['r2', 'token-of-r1', 'unauthorized'],
    ['r2', 'any-robot', 'robot.welcome'],
    ['r1', 'operator-token', 'unauthorized'],
    ['r1', undefined, 'unauthorized'],
  ])('robot %s with %s: %s', (id, token, answer) => {
    const { robot } = setup({ robots, operators });
    const r = robot(id, 'k', token === undefined ? {} : { token });
    expect(r.types()).toEqual([answer]);
    expect(r.peer.closed === null).toBe(answer === 'robot.welcome');
  });

  test('operators need a token, too', () => {
    const { operator } = setup({ robots, operators });
    expect(operator('Ada', { token: 'operator-token' }).types()).toEqual(['operator.welcome', 'robots']);
    for (const more of [{}, { token: 'any-robot' }, { token: 'operator-toke' }]) {
      expect(operator('Eve', more).types()).toEqual(['unauthorized']);
    }
  });
});

describe('sessions', () => {
  test('are opened by the operator and requested from the robot', () => {
    const { robot, operator } = setup();
    const r = robot('r1');
    const o = operator('Ada');
    r.take();
    o.take();
    o.send({ type: 'session.open', robotId: 'r1' });
    expect(o.take()).toEqual([{ type: 'session.opened', session: 's1', robotId: 'r1' }]);
    expect(r.take()).toEqual([{ type: 'session.request', session: 's1', operator: 'Ada' }]);
  });

  test('relay offer, answer and candidates unchanged, each in its direction', () => {
    const { session, observer } = setup();
    const { r, o, handle } = session();
    const candidate = { candidate: 'candidate:1 1 udp 1 ::1 9 typ host', sdpMid: null, sdpMLineIndex: 0 };
    const offer = { type: 'session.offer', session: handle, sdp: 'v=0\r\n' };
    r.send(offer);
    r.send({ type: 'session.candidate', session: handle, candidate });
    expect(o.take()).toEqual([offer, { type: 'session.candidate', session: handle, candidate }]);
    const answer = { type: 'session.answer', session: handle, sdp: 'v=0 answer' };
    o.send(answer);
    o.send({ type: 'session.candidate', session: handle, candidate: { candidate: '' } });
    expect(r.take()).toEqual([
      answer,
      { type: 'session.candidate', session: handle, candidate: { candidate: '' } },
    ]);
    r.send(offer); // a re-offer
    expect(o.take()).toEqual([offer]);
    const relayed = ['offer', 'candidate', 'answer', 'candidate', 'offer'];
    expect(observer.relays).toEqual(relayed.map((what) => `session.${what}`));
  });

  test('refuse the wrong direction', () => {
    const { session } = setup();
    const { r, o, handle } = session();
    r.send({ type: 'session.answer', session: handle, sdp: 'v=0' });
    o.send({ type: 'session.offer', session: handle, sdp: 'v=0' });
    r.send({ type: 'session.open', robotId: 'r1' });
    expect([r.types(), o.types()]).toEqual([['malformed', 'malformed'], ['malformed']]);
  });

  test('belong to their two sockets: nobody else can relay in them or close them', () => {
    const { session, robot, operator } = setup();
    const { r, o, handle } = session('r1');
    const otherRobot = robot('r2');
    const otherOperator = operator('Eve');
    otherRobot.take();
    otherOperator.take();
    o.take();
    const refusal = { type: 'error', code: 'unknown-session', message: 'you have no such session' };
    for (const [stranger, says] of [
      [otherRobot, 'session.offer'],
      [otherOperator, 'session.answer'],
    ] as const) {
      stranger.send({ type: says, session: handle, sdp: 'v=0' });
      stranger.send({ type: 'session.candidate', session: handle, candidate: { candidate: 'c' } });
      stranger.send({ type: 'session.close', session: handle });
      expect(stranger.take()).toEqual(Array(3).fill({ ...refusal, session: handle }));
    }
    expect([r.take(), o.take()]).toEqual([[], []]);
  });

  test('when closed by one side, are reported as closed to the other', () => {
    const { session, observer } = setup();
    const first = session('r1');
    first.o.send({ type: 'session.close', session: first.handle });
    expect(first.r.take()).toEqual([closed(first.handle, 'closed-by-operator')]);
    expect(first.o.take()).toEqual([]);
    const second = session('r2');
    second.r.send({ type: 'session.close', session: second.handle });
    expect(second.o.take()).toEqual([closed(second.handle, 'closed-by-robot')]);
    second.o.send({ type: 'session.close', session: second.handle });
    expect(second.o.types()).toEqual(['unknown-session']);
    const full = session('r3');
    const reason = { reason: 'robot-full', maxOperators: 4 };
    full.r.send({ type: 'session.close', session: full.handle, ...reason });
    expect(full.o.take()).toEqual([{ type: 'session.closed', session: full.handle, ...reason }]);
    expect(observer.sessionEnds).toEqual(['closed-by-operator', 'closed-by-robot', 'robot-full']);
  });

  test('end when either side leaves', () => {
    const { session, clock } = setup();
    const first = session('r1');
    first.o.connection.closed();
    expect(first.r.take()).toEqual([closed(first.handle, 'operator-left')]);
    const second = session('r2');
    second.r.connection.closed();
    clock.advance(0);
    expect(second.o.take()).toEqual([
      closed(second.handle, 'robot-left'),
      { type: 'robots.changed', here: [], gone: ['r2'] },
    ]);
  });

  describe('resumed', () => {
    const resume = (session: string, robotId = 'r1') => ({
      type: 'session.resume',
      session,
      robotId,
      resumeKey: 'key',
    });
    /** The claim in the robot's only message. */
    const claimOf = (robot: FakeClient, session: string): string => {
      const [asked, ...more] = robot.take();
      expect(more).toEqual([]);
      expect(asked).toMatchObject({ type: 'session.resume', session, operator: 'Ada', resumeKey: 'key' });
      return asked?.claim as string;
    };
    const offer = (session: string, claim: string) => ({ type: 'session.offer', session, sdp: 'v=0', claim });

    test('by its own socket, by a newer one, and if the service has forgotten it', () => {
      const { session, operator, robot, hub, observer } = setup();
      const { r, o, handle } = session('r1');
      const resuming = { type: 'session.resuming', session: handle };
      const accepted = [
        { type: 'session.opened', session: handle, robotId: 'r1' },
        { type: 'session.offer', session: handle, sdp: 'v=0' },
      ];
      o.send(resume(handle));
      expect(o.take()).toEqual([resuming]);
      r.send(offer(handle, claimOf(r, handle)));
      expect(o.take()).toEqual(accepted);
      // A newer socket of the same operator while the old one is half-open.
      const o2 = operator();
      o2.take();
      o2.send(resume(handle));
      expect(o2.take()).toEqual([resuming]);
      r.send(offer(handle, claimOf(r, handle)));
      expect(o2.take()).toEqual(accepted);
      o.connection.closed();
      expect(r.take()).toEqual([]);
      // And a newer socket of the robot.
      const r2 = robot('r1');
      r2.take();
      expect(o2.take()).toEqual([closed(handle, 'robot-left')]);
      o2.send(resume(handle));
      expect(o2.take()).toEqual([resuming]);
      r2.send(offer(handle, claimOf(r2, handle)));
      expect(o2.take()).toEqual(accepted);
      expect(hub.counts.sessions).toBe(1);
      expect(observer.sessionEnds).toEqual(['operator-left', 'robot-left']);
    });

    test.each(['wrong-resume-key', 'resume-too-soon'])(
      '%s: reported to the asker, and nothing else changes',
      (code) => {
        const { session, operator, hub } = setup();
        const { r, o, handle } = session('r1');
        const stranger = operator();
        stranger.take();
        stranger.send(resume(handle));
        expect(stranger.types()).toEqual(['session.resuming']);
        const claim = claimOf(r, handle);
        // Before and after the robot's judgement, the session belongs to the same operator.
        for (const judged of [false, true]) {
          stranger.send({ type: 'session.close', session: handle });
          stranger.send({ type: 'session.answer', session: handle, sdp: 'v=0' });
          expect(stranger.types()).toEqual(['unknown-session', 'unknown-session']);
          o.send({ type: 'session.candidate', session: handle, candidate: { candidate: 'c' } });
          r.send({ type: 'session.candidate', session: handle, candidate: { candidate: 'd' } });
          expect([r.types(), o.types()]).toEqual([['session.candidate'], ['session.candidate']]);
          if (judged) break;
          r.send({ type: 'session.refuse', session: handle, claim, code });
          expect(stranger.take()).toEqual([
            { type: 'error', code, message: expect.any(String), session: handle },
          ]);
        }
        // A claim can be judged only once.
        r.send(offer(handle, claim));
        expect([stranger.take(), o.types()]).toEqual([[], ['session.offer']]);
        stranger.connection.closed();
        expect([r.take(), o.take(), hub.counts.sessions]).toEqual([[], [], 1]);
      },
    );

    test('two at once: the robot says which claim it answers', () => {
      const { session, operator } = setup();
      const { r, handle } = session('r1');
      const [stranger, genuine] = [operator(), operator()];
      for (const socket of [stranger, genuine]) {
        socket.take();
        socket.send(resume(handle));
        socket.take();
      }
      const [first, second] = r.take().map(({ claim }) => claim as string);
      r.send(offer(handle, second as string));
      r.send({ type: 'session.refuse', session: handle, claim: first, code: 'wrong-resume-key' });
      expect(genuine.types()).toEqual(['session.opened', 'session.offer']);
      expect(stranger.types()).toEqual(['wrong-resume-key']);
    });

    test('a robot without the session ends it for the asker', () => {
      const { session, operator, hub } = setup();
      const { r, o, handle } = session('r1');
      const other = operator();
      for (const asker of [other, o]) {
        asker.take();
        asker.send(resume(handle));
        const claim = claimOf(r, handle);
        r.send({ type: 'session.refuse', session: handle, claim, code: 'unknown-session' });
        expect(asker.take().at(-1)).toEqual(closed(handle, 'unknown-session'));
      }
      expect([r.take(), hub.counts.sessions]).toEqual([[], 0]);
    });

    test('a claim ends with the socket that made it, or with its robot’s', () => {
      const { session, operator, robot } = setup();
      const { r, o, handle } = session('r1');
      const gone = operator();
      gone.send(resume(handle));
      const claim = claimOf(r, handle);
      gone.connection.closed();
      r.send({ type: 'session.refuse', session: handle, claim, code: 'unknown-session' });
      expect(o.take()).toEqual([]);
      const waiting = operator();
      waiting.take();
      waiting.send(resume(handle));
      const older = claimOf(r, handle);
      const r2 = robot('r1');
      r2.send({ type: 'session.refuse', session: handle, claim: older, code: 'unknown-session' });
      expect(waiting.types()).toEqual(['session.resuming']);
    });

    test('cannot be with another robot, or with one that is not connected', () => {
      const { session, robot } = setup();
      const { r, o, handle } = session('r1');
      const other = robot('r2');
      o.take();
      other.take();
      o.send(resume(handle, 'r2'));
      o.send(resume(handle, 'nobody'));
      expect(o.take().filter(({ type }) => type === 'error')).toMatchObject([
        { code: 'unknown-session', session: handle },
        { code: 'unknown-robot', session: handle },
      ]);
      expect([r.take(), other.take()]).toEqual([[], []]);
    });
  });

  test('with an unknown robot are refused', () => {
    const { operator } = setup();
    const o = operator();
    o.take();
    o.send({ type: 'session.open', robotId: 'nobody' });
    expect(o.take()).toEqual([
      { type: 'error', code: 'unknown-robot', message: 'robot nobody is not connected' },
    ]);
  });

  test('are limited for each side, and are released when closed', () => {
    const { robot, operator, hub } = setup();
    robot('r1');
    robot('r2');
    const [a, b] = [operator('A'), operator('B')];
    a.send({ type: 'session.open', robotId: 'r1' });
    a.send({ type: 'session.open', robotId: 'r1' });
    b.take();
    b.send({ type: 'session.open', robotId: 'r1' });
    expect(b.types()).toEqual(['too-many-sessions']); // the robot's
    a.take();
    a.send({ type: 'session.open', robotId: 'r2' });
    expect(a.types()).toEqual(['too-many-sessions']); // the operator's
    a.send({ type: 'session.close', session: 's1' });
    b.send({ type: 'session.open', robotId: 'r1' });
    expect(b.types()).toEqual(['session.opened']);
    a.connection.closed();
    b.connection.closed();
    expect(hub.counts.sessions).toBe(0);
  });
});

describe('lists of robots', () => {
  test('tells every operator when robots come, go or change their names', () => {
    const { robot, operator, clock } = setup();
    const o = operator();
    o.take();
    const r = robot('r1');
    clock.advance(0);
    expect(o.take()).toEqual([{ type: 'robots.changed', here: [{ id: 'r1', name: 'Robot r1' }], gone: [] }]);
    clock.advance(100);
    robot('r1', 'key-r1', { name: 'New' });
    clock.advance(0);
    expect(o.take()).toEqual([{ type: 'robots.changed', here: [{ id: 'r1', name: 'New' }], gone: [] }]);
    r.connection.closed();
    clock.advance(1000);
    expect(o.take()).toEqual([]);
  });
});

describe('what is not a message of the protocol', () => {
  const junk: [string, string | Uint8Array][] = [
    ['text', 'hello?'],
    ['null', 'null'],
    ['a number', '7'],
    ['a list', '[]'],
    ['nothing', ''],
    ['another type', '{"type":"sudo"}'],
    ['a key too many', '{"type":"session.close","session":"s1","x":1}'],
    ['__proto__', '{"type":"session.close","session":"s1","__proto__":{"a":1}}'],
    ['a wrong handle', '{"type":"session.close","session":"../etc"}'],
    ['deep nesting', '['.repeat(2000)],
    ['deep nesting that closes', `{"type":"session.close","session":${'['.repeat(1000)}${']'.repeat(1000)}}`],
    ['binary', new Uint8Array([1, 2, 3])],
    ['JSON as binary', new TextEncoder().encode('{"type":"session.close","session":"s1"}')],
  ];

  test.each(junk)('%s is refused without harm to others', (_, data) => {
    const { session, hub } = setup();
    const { r, o, handle } = session();
    r.connection.receive(data);
    o.connection.receive(data);
    expect([r.types(), o.types()]).toEqual([['malformed'], ['malformed']]);
    r.send({ type: 'session.offer', session: handle, sdp: 'v=0' });
    expect(o.types()).toEqual(['session.offer']);
    new FakeClient((peer) => hub.robot(peer)).connection.receive(data);
  });

  test('a message that is too long is refused', () => {
    const { session } = setup();
    const { r, handle } = session();
    r.send({ type: 'session.offer', session: handle, sdp: 'x'.repeat(5000) });
    expect(r.types()).toEqual(['too-large']);
  });

  test('after too many, the socket is closed; its sessions end once it is gone', () => {
    const { session, observer } = setup();
    const { r, o } = session();
    for (let i = 0; i < 7; i++) r.connection.receive('x');
    expect(r.types()).toEqual(['malformed', 'malformed', 'malformed', 'malformed', 'malformed']);
    expect(r.peer.closed).toEqual({ code: 1008, reason: 'too many refused messages' });
    expect(observer.rejects.at(-1)).toBe('robot: too-many-faults');
    r.connection.closed();
    expect(o.types()).toEqual(['session.closed']);
  });

  test('a duplicate key reaches the other side once, with the value that was validated', () => {
    const { session } = setup();
    const { r, o, handle } = session();
    r.connection.receive(`{"type":"session.offer","session":"evil","session":"${handle}","sdp":"v=0"}`);
    expect(o.take()).toEqual([{ type: 'session.offer', session: handle, sdp: 'v=0' }]);
  });
});

test('surplus messages are dropped and reported once, and accepted again after a pause', () => {
  const { session, clock } = setup();
  const { r, o, handle } = session();
  for (let i = 0; i < 22; i++) {
    r.send({ type: 'session.candidate', session: handle, candidate: { candidate: `c${i}` } });
  }
  expect(o.take()).toHaveLength(19); // 20 at once, one of which was the hello
  expect(r.types()).toEqual(['rate-limited']);
  clock.advance(100); // a tenth of a second at 10 per second
  r.send({ type: 'session.offer', session: handle, sdp: 'v=0' });
  expect(o.types()).toEqual(['session.offer']);
});

test('ten operators send a robot no more than its budget', () => {
  const { robot, operator } = setup({ more: { relayMessagesPerSecond: 2, maxSessionsPerRobot: 10 } });
  const r = robot('r1');
  const flood = Array.from({ length: 10 }, () => operator());
  for (const o of flood) o.send({ type: 'session.open', robotId: 'r1' });
  r.take();
  for (const o of flood) {
    const { session } = o.take().find(({ type }) => type === 'session.opened') ?? {};
    for (let i = 0; i < 5; i++) o.send({ type: 'session.answer', session, sdp: 'v=0' });
  }
  expect(r.types().length).toBeLessThan(10);
  expect(flood.flatMap((o) => o.take().map(({ code }) => code))).toContain('rate-limited');
});

test('at shutdown, tells everybody to reconnect, and closes with 1012', () => {
  const { session, hub } = setup();
  const { r, o } = session();
  const newcomer = new FakeClient((peer) => hub.operator(peer));
  for (const client of [r, o, newcomer]) {
    client.connection.shutDown();
    expect(client.types()).toEqual(['shutting-down']);
    expect(client.peer.closed?.code).toBe(1012);
  }
});
