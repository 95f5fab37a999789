import { clockAnswerCodec, decodeJson, encodeBandwidth, NO_LEASE, zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { WishesListener } from './operator-wishes.ts';
import { sessionRobot } from './testing/session-robot.ts';

function robot() {
  const made = sessionRobot();
  return { ...made, alice: made.operator('alice'), bob: made.operator('bob') };
}

describe('OperatorMessages', () => {
  it('lets the lease holder drive and tells the other operator who drives', () => {
    const { alice, bob, speed } = robot();
    const lease = alice.takeLease();
    expect(bob.inbox.at(-1)).toEqual({ type: 'lease', holder: 'other' });
    alice.command(0, lease, 0.4);
    expect(speed()).toBe(0.4);
  });

  it('does not answer one who does not drive and says that its hand is open', () => {
    const { alice, bob, speed, rejected } = robot();
    const lease = alice.takeLease();
    const heard = bob.inbox.length;
    for (let sequence = 0; sequence < 5; sequence++) bob.command(sequence, NO_LEASE, 0, { deadMan: false });
    expect([bob.inbox.length, rejected]).toEqual([heard, []]);
    // A hand that has not said so.
    bob.command(5, NO_LEASE, 0.4);
    expect(rejected).toMatchObject([{ reason: 'not-lease-holder' }]);
    alice.command(0, lease, 0.4);
    expect(speed()).toBe(0.4);
  });

  it('rejects the other operator’s commands and reports the reason in summary', () => {
    const { alice, bob, speed, pass, rejected } = robot();
    const lease = alice.takeLease();
    bob.inbox.length = 0;
    for (let i = 0; i < 5; i++) {
      bob.command(i, lease, 0.4);
      pass(20);
      bob.session.flushRejections();
    }
    pass(100);
    bob.session.flushRejections();
    expect(speed()).toBe(0);
    expect(rejected).toHaveLength(5);
    const reports = bob.inbox.filter((message) => message.type === 'rejected');
    expect(reports.reduce((sum, report) => sum + report.count, 0)).toBe(5);
    expect(reports.length).toBeLessThan(4);
    expect(reports.every((report) => report.reason === 'not-lease-holder')).toBe(true);
  });

  it('stops when the lease is released', () => {
    const { alice, bob, speed } = robot();
    const lease = alice.takeLease();
    alice.command(0, lease, 0.4);
    alice.send({ type: 'leaseRelease' });
    expect(speed()).toBe(0);
    expect(bob.inbox.at(-1)).toEqual({ type: 'lease', holder: 'nobody' });
  });

  it('notes when it had each command, had judged it and had told the drive', () => {
    const { alice, bob, pass } = robot();
    const lease = alice.takeLease();
    alice.command(0, lease, 0.4);
    pass(25);
    alice.command(1, lease, 99);
    bob.command(0, NO_LEASE, 0, { deadMan: false });
    expect(alice.session.stages.due(2000, false)?.commands).toEqual([
      [0, 1_000_000, 0, 0],
      [1, 1_025_000, 0, null],
    ]);
    expect(bob.session.stages.due(2000, false)).toBe(null);
  });

  it('says why a lease is not granted', () => {
    const { alice, bob } = robot();
    alice.takeLease();
    bob.send({ type: 'leaseRequest', take: false });
    expect(bob.inbox.slice(-2)).toEqual([
      { type: 'fault', message: 'another operator drives' },
      { type: 'lease', holder: 'other' },
    ]);
  });

  it('requests a latency-test frame only for an accepted command', () => {
    const { alice, bob, tests } = robot();
    const lease = alice.takeLease();
    bob.command(0, lease, 0, { latencyTest: 1 });
    expect(tests).toEqual([]);
    alice.command(0, lease, 0, { latencyTest: 2 });
    expect(tests).toEqual([['alice', 2, 1000]]);
  });

  it('answers clock probes at once', () => {
    const { alice } = robot();
    alice.session.onMessage('control', '{"type":"clockProbe","id":3,"sentMs":12.5}');
    expect(alice.control.map((text) => decodeJson(clockAnswerCodec, text))).toEqual([
      { type: 'clockAnswer', id: 3, sentMs: 12.5, robotMs: 1000 },
    ]);
  });

  it('passes on limits, and receiver reports unless a newer one came before', () => {
    const { alice } = robot();
    const reports: number[] = [];
    alice.session.onReceiverReport = (report) => reports.push(report.sequence);
    for (const sequence of [5, 4, 5, 6]) {
      const report = {
        type: 'receiverReport',
        sequence,
        packetsReceived: 1,
        packetsLost: 0,
        bytesReceived: 1,
      };
      alice.session.onMessage('control', JSON.stringify(report));
    }
    expect(reports).toEqual([5, 6]);
    let limit = 0;
    alice.session.onReceiverLimit = (bitsPerSecond) => {
      limit = bitsPerSecond;
    };
    alice.session.onMessage('bandwidth', encodeBandwidth(3e6));
    expect(limit).toBe(3e6);
  });

  it('switches the stream by message and by the reference system’s words', () => {
    const { alice } = robot();
    const switches: boolean[] = [];
    alice.session.wishes.listener = {
      switchStream: (running) => void switches.push(running),
    } as WishesListener;
    for (const word of ['stop', 'start']) alice.session.onMessage('session', word);
    alice.send({ type: 'stream', running: false });
    alice.send({ type: 'stream', running: true });
    expect(switches).toEqual([false, true, false, true]);
  });

  it('reports a broken command as malformed and a broken request as a fault', () => {
    const { alice, unread } = robot();
    alice.session.onMessage('control', '{"type":"command"}');
    expect(alice.inbox.at(-1)).toMatchObject({ type: 'rejected', reason: 'malformed', count: 1 });
    alice.session.onMessage('session', '{"type":"dance"}');
    expect(alice.inbox.at(-1)).toMatchObject({ type: 'fault' });
    alice.session.onMessage('bandwidth', 'fast');
    expect(unread.map(([channel]) => channel)).toEqual(['control', 'session', 'bandwidth']);
  });

  it('drops what exceeds an operator’s limits, by kind, and still takes its emergency stop', () => {
    const { alice, guard, limited } = robot();
    for (let id = 0; id < 300; id++) {
      alice.session.onMessage('control', JSON.stringify({ type: 'clockProbe', id, sentMs: 0 }));
      alice.send({ type: 'leaseRequest', take: false });
    }
    expect(limited).toEqual(new Set(['probe', 'lease', 'session']));
    alice.send({ type: 'estop', latch: true });
    expect(guard.estopState().latched).toBe(true);
  });

  it('stands still whatever bytes a watching operator sends', () => {
    const { alice, bob, speed } = robot();
    alice.takeLease();
    const text = fc.oneof(fc.string(), fc.json(), fc.constantFrom('start', '{"type":"leaseRelease"}'));
    const data = fc.oneof<fc.Arbitrary<string | Uint8Array>[]>(text, fc.uint8Array({ maxLength: 2000 }));
    fc.assert(
      fc.property(fc.constantFrom('session', 'control', 'bandwidth'), data, (channel, message) => {
        bob.session.onMessage(channel as 'session', message);
        expect(speed()).toBe(0);
      }),
      { seed: 9, numRuns: 500 },
    );
  });
});

describe('roles', () => {
  const granted = (role: 'watch' | 'drive' | 'supervise') => ({
    ...{ role, subject: 'x', name: 'X', expiresAtS: 1e12, keyId: 'k' },
    grant: { id: 'g', subject: 'x', keyId: 'k', issuedAtS: 0 },
  });
  const leaseRequest = (take: boolean) => JSON.stringify({ type: 'leaseRequest', take });
  const estop = (latch: boolean) => JSON.stringify({ type: 'estop', latch, ...(latch ? {} : { of: 1 }) });

  it('who may only watch takes no lease, sends no command that is looked at, but stops the robot', () => {
    const { alice: a, guard, rejected } = robot();
    a.session.access = granted('watch');
    a.session.onMessage('session', leaseRequest(true));
    expect(guard.leaseHolder).toBeNull();
    expect(a.inbox.splice(0)).toMatchObject([
      { type: 'fault', reason: 'not-permitted' },
      { type: 'lease', holder: 'nobody' },
    ]);
    const twist = { ...zeroTwist(), linear: { x: 0.5, y: 0, z: 0 } };
    const command = { type: 'command', sequence: 1, timeMs: 0, lease: 'x', deadMan: true, twist };
    a.session.onMessage('control', JSON.stringify(command));
    expect(rejected).toMatchObject([{ reason: 'not-permitted' }]);
    expect(a.inbox.splice(0)).toMatchObject([{ type: 'rejected', reason: 'not-permitted', sequence: 1 }]);
    a.session.onMessage('session', estop(true));
    expect(guard.estopState().latched).toBe(true);
    a.inbox.splice(0);
    a.session.onMessage('session', estop(false));
    expect(guard.estopState().latched).toBe(true);
    expect(a.inbox).toMatchObject([{ type: 'fault', reason: 'not-permitted' }, { type: 'estop' }]);
  });

  it('only a supervisor ends the sessions of others', () => {
    const { alice: a } = robot();
    const ended: number[] = [];
    a.session.onEndSession = ({ operator }) => ended.push(operator);
    const end = JSON.stringify({ type: 'endSession', operator: 3, block: true });
    // Without grants, nobody supervises.
    a.session.onMessage('session', end);
    for (const role of ['watch', 'drive'] as const) {
      a.session.access = granted(role);
      a.session.onMessage('session', end);
    }
    expect(ended).toEqual([]);
    expect(a.inbox).toMatchObject(
      Array.from({ length: 3 }, () => ({ type: 'fault', reason: 'not-permitted' })),
    );
    a.session.access = granted('supervise');
    a.session.onMessage('session', end);
    expect(ended).toEqual([3]);
  });

  it('who watches draws no barcode into what others see', () => {
    const { alice: a } = robot();
    const wanted: boolean[] = [];
    a.session.wishes.listener = { wantVideos: (_, barcode) => void wanted.push(barcode) } as WishesListener;
    const videos = JSON.stringify({ type: 'videos', videos: [0], barcode: true });
    a.session.onMessage('session', videos);
    a.session.access = granted('watch');
    a.session.onMessage('session', videos);
    expect(wanted).toEqual([true, false]);
  });
});
