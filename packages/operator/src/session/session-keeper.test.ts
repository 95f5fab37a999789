import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { SessionKeeper } from './session-keeper.ts';
import type { SessionLoss } from './session-loss.ts';

const HERE = [{ id: 'rover', name: 'Rover' }];

class Bench {
  readonly requests: string[] = [];
  readonly closed: string[] = [];
  readonly losses: SessionLoss[] = [];
  readonly resumed: string[] = [];
  readonly paths: boolean[] = [];
  drops = 0;
  now = 0;
  readonly keeper = new SessionKeeper(
    {
      requestSession: (id) => this.requests.push(id),
      resumeSession: (session, robotId) => this.resumed.push(`${session} ${robotId}`),
      closeSession: (session) => this.closed.push(session),
      dropPeer: () => this.drops++,
      onPhase: () => undefined,
      onLoss: (loss) => this.losses.push(loss),
      onPath: (up) => this.paths.push(up),
    },
    () => 0.5,
  );

  /** The service and the robot are available, and the robot is wanted. */
  wanted(): this {
    this.keeper.onSignaling(true, this.now);
    this.keeper.want('rover', HERE, this.now);
    return this;
  }

  live(session = 's1'): this {
    this.wanted();
    this.keeper.onOpened(session, 'rover');
    this.keeper.onPeerConnected(this.now);
    expect(this.keeper.phase).toBe('live');
    return this;
  }

  pass(ms: number, heard = false): void {
    for (const end = this.now + ms; this.now < end; ) {
      this.now += 250;
      if (heard) {
        this.keeper.onHeard(this.now);
        this.keeper.onAnswered(this.now);
      }
      this.keeper.update(this.now);
    }
  }
}

describe('SessionKeeper', () => {
  test('opens a session once the service and the robot are available', () => {
    const bench = new Bench();
    bench.keeper.want('rover', [], 0);
    bench.keeper.onSignaling(true, 0);
    expect(bench.requests).toEqual([]);
    bench.keeper.onRobots(HERE, 0);
    expect(bench.requests).toEqual(['rover']);
    expect(bench.keeper.phase).toBe('opening');
  });

  test('a live session outlives signaling', () => {
    const bench = new Bench().live();
    bench.keeper.onSignaling(false, bench.now);
    bench.pass(60_000, true);
    bench.keeper.onSignaling(true, bench.now);
    bench.keeper.onRobots(HERE, bench.now);
    bench.pass(5000, true);
    expect(bench.keeper.phase).toBe('live');
    expect(bench.requests).toHaveLength(1);
  });

  test('a live session outlives the robot’s signaling, too', () => {
    const bench = new Bench().live();
    bench.keeper.onClosed('s1', 'robot-left', bench.now);
    bench.keeper.onRobots([], bench.now);
    bench.pass(5000, true);
    bench.keeper.onRobots(HERE, bench.now);
    bench.pass(5000, true);
    expect(bench.keeper.phase).toBe('live');
    expect(bench.drops).toBe(0);
  });

  test('during an outage, asks for a new path in the same session until the robot is heard again', () => {
    const bench = new Bench().live();
    bench.pass(35_000);
    expect(bench.keeper.phase).toBe('live');
    expect(bench.keeper.interrupted).toBe(true);
    expect(new Set(bench.resumed)).toEqual(new Set(['s1 rover']));
    expect(bench.resumed).toHaveLength(35);
    bench.keeper.onHeard(bench.now);
    expect(bench.keeper.interrupted).toBe(false);
    expect(bench.paths).toEqual([false, true]);
    bench.pass(5000, true);
    expect(bench.resumed).toHaveLength(35);
    expect([bench.losses, bench.drops]).toEqual([[], 0]);
  });

  test('an outage of a minute ends the session', () => {
    const bench = new Bench().live();
    bench.pass(59_000);
    expect(bench.losses).toEqual([]);
    bench.pass(1000);
    expect(bench.losses).toEqual(['silent']);
    expect(bench.closed).toEqual(['s1']);
  });

  test('asks for a new path at once when signaling comes back', () => {
    const bench = new Bench().live();
    bench.keeper.onSignaling(false, bench.now);
    bench.pass(10_000);
    expect(bench.resumed).toEqual([]);
    bench.keeper.onSignaling(true, bench.now);
    expect(bench.resumed).toHaveLength(1);
    bench.keeper.onRobots([], bench.now);
    bench.pass(3000);
    expect(bench.resumed).toHaveLength(1);
    bench.keeper.onRobots(HERE, bench.now);
    expect(bench.resumed).toHaveLength(2);
  });

  test('opens a new session at once if the robot has restarted and does not know the old one', () => {
    const bench = new Bench().live();
    bench.keeper.onRobots([], bench.now);
    bench.pass(4000);
    expect(bench.keeper.phase).toBe('live');
    bench.keeper.onRobots(HERE, bench.now);
    expect(bench.resumed).toEqual(['s1 rover']);
    bench.keeper.onClosed('s1', 'unknown-session', bench.now);
    expect(bench.losses).toEqual(['robot-restarted']);
    expect(bench.requests).toHaveLength(2);
    expect(bench.drops).toBe(1);
  });

  test('a robot that restarts before its silence is noticed', () => {
    const bench = new Bench().live();
    bench.keeper.onClosed('s1', 'robot-left', bench.now);
    bench.pass(750);
    expect(bench.resumed).toEqual([]);
    bench.pass(250);
    expect(bench.resumed).toHaveLength(1);
  });

  test.each([
    ['robot-full', 'robot-full'],
    ['bad-answer', 'bad-answer'],
    ['grant-expired', 'grant-expired'],
    ['grant-revoked', 'grant-revoked'],
    ['unproven-peer', 'unproven-peer'],
    ['shutting-down', 'robot-stopped'],
    ['silent', 'unheard'],
    ['closed-by-robot', 'closed-by-robot'],
  ] as const)('ended by the robot, %s: said so, and tried again after a while', (reason, loss) => {
    const bench = new Bench().wanted();
    bench.keeper.onOpened('s1', 'rover');
    bench.keeper.onClosed('s1', reason, bench.now);
    expect([bench.losses, bench.requests.length]).toEqual([[loss], 1]);
    bench.pass(500);
    expect(bench.requests).toHaveLength(2);
  });

  test('a loss that would come again is final, until somebody has done something', () => {
    const bench = new Bench().wanted();
    const refuse = () => {
      bench.keeper.onOpened('s1', 'rover');
      bench.keeper.onClosed('s1', 'not-granted', bench.now);
    };
    refuse();
    expect([bench.losses, bench.keeper.phase]).toEqual([['not-granted'], 'waiting']);
    bench.pass(60_000);
    expect(bench.requests).toHaveLength(1);
    bench.keeper.retry(bench.now);
    expect(bench.requests).toHaveLength(2);
    refuse();
    // The robot comes back, perhaps with other keys.
    bench.keeper.onRobots([], bench.now);
    bench.keeper.onRobots(HERE, bench.now);
    expect(bench.requests).toHaveLength(3);
    bench.keeper.onPeerFailed(bench.now, 'robot-key-changed');
    bench.pass(60_000);
    expect([bench.losses.at(-1), bench.requests.length]).toEqual(['robot-key-changed', 3]);
    bench.keeper.retry(bench.now);
    bench.keeper.onOpened('s4', 'rover');
    bench.keeper.onPeerConnected(bench.now);
    bench.keeper.retry(bench.now);
    expect([bench.keeper.phase, bench.requests.length]).toEqual(['live', 4]);
  });

  test('a connection that ends waits a moment for the reason, which takes the other way', () => {
    const bench = new Bench().live();
    bench.keeper.onPeerFailed(bench.now);
    expect([bench.losses, bench.paths, bench.keeper.interrupted]).toEqual([[], [false], true]);
    bench.pass(250);
    bench.keeper.onClosed('s1', 'ended-by-supervisor', bench.now);
    bench.pass(60_000);
    expect([bench.losses, bench.requests.length]).toEqual([['ended-by-supervisor'], 1]);
  });

  test('without a reason, or a service that could tell it, it was the connection', () => {
    const waited = new Bench().live();
    waited.keeper.onPeerFailed(waited.now);
    waited.pass(500);
    // As soon as without the wait.
    expect([waited.losses, waited.requests.length]).toEqual([['connection-failed'], 2]);
    const alone = new Bench().live();
    alone.keeper.onSignaling(false, alone.now);
    alone.keeper.onPeerFailed(alone.now);
    expect(alone.losses).toEqual(['connection-failed']);
  });

  test('ended by a supervisor: connects again only when the operator asks for it', () => {
    const bench = new Bench().live();
    bench.keeper.onClosed('s1', 'ended-by-supervisor', bench.now);
    expect([bench.losses, bench.keeper.phase, bench.keeper.robotId]).toEqual([
      ['ended-by-supervisor'],
      'none',
      null,
    ]);
    bench.pass(60_000);
    bench.keeper.onRobots([], bench.now);
    bench.keeper.onRobots(HERE, bench.now);
    expect(bench.requests).toHaveLength(1);
    bench.keeper.want('rover', HERE, bench.now);
    expect(bench.requests).toHaveLength(2);
  });

  test('leaving the page ends the session, and returning opens another', () => {
    const bench = new Bench().live();
    bench.keeper.want(null, HERE, bench.now);
    bench.keeper.onSignaling(false, bench.now);
    bench.pass(10_000);
    expect([bench.closed, bench.drops, bench.keeper.phase]).toEqual([['s1'], 1, 'none']);
    bench.keeper.want('rover', HERE, bench.now);
    expect(bench.keeper.phase).toBe('waiting');
    bench.keeper.onSignaling(true, bench.now);
    expect(bench.requests).toHaveLength(2);
  });

  test('retries a failed connection at growing intervals, and at once when the robot comes back', () => {
    const bench = new Bench().live();
    const gaps: number[] = [];
    for (let i = 0; i < 5; i++) {
      const failed = bench.now;
      bench.keeper.onPeerFailed(bench.now);
      const { length } = bench.requests;
      while (bench.requests.length === length) bench.pass(250);
      gaps.push(bench.now - failed);
      bench.keeper.onOpened(`t${i}`, 'rover');
    }
    expect(gaps).toEqual([500, 1000, 2000, 4000, 5000]);
    bench.keeper.onPeerFailed(bench.now);
    bench.keeper.onRobots([], bench.now);
    bench.keeper.onRobots(HERE, bench.now);
    expect(bench.keeper.phase).toBe('opening');
  });

  test('gives up a session that is not established in time, and tries again', () => {
    const bench = new Bench().wanted();
    bench.keeper.onOpened('s1', 'rover');
    bench.pass(15_000);
    expect(bench.losses).toEqual(['not-connected']);
    expect(bench.closed).toEqual(['s1']);
    bench.pass(1000);
    expect(bench.requests).toHaveLength(2);
  });

  test('refusals count only if they concern the session that is being opened', () => {
    const bench = new Bench().wanted();
    bench.keeper.onRefused('old', bench.now);
    expect(bench.keeper.phase).toBe('opening');
    bench.keeper.onRefused(undefined, bench.now);
    expect(bench.losses).toEqual(['refused']);
    const live = new Bench().live();
    live.keeper.onRefused(undefined, live.now);
    expect(live.keeper.phase).toBe('live');
  });

  test('signaling lost before the peers are connected: tries again when it is back', () => {
    const bench = new Bench().wanted();
    bench.keeper.onSignaling(false, bench.now);
    expect(bench.losses).toEqual(['signaling-lost']);
    bench.pass(5000);
    expect(bench.requests).toHaveLength(1);
    bench.keeper.onSignaling(true, bench.now);
    expect(bench.requests).toHaveLength(2);
  });

  test('refuses a session that was not requested', () => {
    const bench = new Bench().live();
    expect(bench.keeper.onOpened('other', 'rover')).toBe(false);
    expect(bench.keeper.session).toBe('s1');
  });

  test('after any events, the session with a robot that answers becomes live', () => {
    const anything = fc.constantFrom(
      'signaling',
      'noSignaling',
      'robot',
      'noRobot',
      'fail',
      'closed',
      'time',
    );
    fc.assert(
      fc.property(fc.array(anything, { maxLength: 40 }), (events) => {
        const bench = new Bench().live();
        for (const event of events) {
          const { keeper, now } = bench;
          if (event === 'signaling' || event === 'noSignaling')
            keeper.onSignaling(event === 'signaling', now);
          else if (event === 'robot' || event === 'noRobot')
            keeper.onRobots(event === 'robot' ? HERE : [], now);
          else if (event === 'fail') keeper.onPeerFailed(now);
          else if (event === 'closed') keeper.onClosed(keeper.session ?? 'x', 'closed-by-robot', now);
          else bench.pass(3000);
        }
        bench.keeper.onSignaling(true, bench.now);
        bench.keeper.onRobots(HERE, bench.now);
        for (let i = 0; i < 40 && bench.keeper.phase !== 'live'; i++) {
          bench.pass(500);
          if (bench.keeper.phase === 'opening') {
            bench.keeper.onOpened(`n${i}`, 'rover');
            bench.keeper.onPeerConnected(bench.now);
          }
        }
        expect(bench.keeper.phase).toBe('live');
      }),
      { seed: 11, numRuns: 300 },
    );
  });
});
