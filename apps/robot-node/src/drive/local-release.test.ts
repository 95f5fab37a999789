import { type Command, type Twist, zeroTwist } from '@farpoint/protocol';
import { DriveGuard, defaultDriveLimits, type EstopReleasePolicy } from '@farpoint/safety';
import { testFolder } from '@farpoint/service/testing/folder';
import { beforeEach, describe, expect, it } from 'vitest';
import { EstopJournal } from './estop-journal.ts';
import { LocalRelease } from './local-release.ts';
import { ReleaseRequest } from './release-request.ts';

const TICK_MS = 25;

let folder: string;
beforeEach(() => {
  folder = testFolder();
});

function setUp(estopRelease: EstopReleasePolicy = 'driver') {
  const guard = new DriveGuard({
    ...{ limits: defaultDriveLimits, estopRelease },
    randomBytes: (count) => new Uint8Array(count).fill(7),
  });
  const request = new ReleaseRequest(folder, 'robot-1');
  const lines: string[] = [];
  const log = { warn: (...said: unknown[]) => lines.push(String(said.at(-1))) };
  let nowMs = 0;
  guard.latchEstop('robot');
  const release = new LocalRelease(request, guard, log as never);
  return {
    ...{ guard, request, lines },
    /** @returns whether it was released in this time */
    run: (ms: number) => {
      let released = false;
      for (const end = nowMs + ms; nowMs < end; nowMs += TICK_MS) released = release.look(nowMs) || released;
      return released;
    },
    now: () => nowMs,
  };
}

describe('LocalRelease', () => {
  it('releases once for each request, and never without one', () => {
    const { guard, request, run } = setUp();
    expect(run(2000)).toBe(false);
    request.make();
    expect(run(250)).toBe(true);
    expect(guard.estopState().latched).toBe(false);
    guard.latchEstop('robot');
    expect(run(2000)).toBe(false);
  });

  it('does not undo a STOP that was pressed after the request', () => {
    const { guard, request, run, lines } = setUp();
    run(250);
    request.make();
    guard.latchEstop('operator', 'ada');
    expect(run(1000)).toBe(false);
    expect(lines).toEqual([expect.stringContaining('latched again in the meantime')]);
    request.make();
    expect(run(250)).toBe(true);
  });

  it('does not release what a stop at the robot holds', () => {
    const { guard, request, run, lines } = setUp();
    guard.holdEstop('gpio');
    run(250);
    request.make();
    expect(run(1000)).toBe(false);
    expect(lines).toEqual([expect.stringContaining('released there')]);
  });

  it.each<[EstopReleasePolicy, boolean]>([
    ['driver', true],
    ['latcher', false],
    ['supervisor', false],
  ])('releases what an operator who is there has latched, by the policy %s: %s', (policy, expected) => {
    const { guard, request, run } = setUp(policy);
    guard.latchEstop('operator', 'ada');
    run(250);
    request.make();
    expect(run(250)).toBe(expected);
    expect(guard.estopState().latched).toBe(!expected);
  });

  it('moves nothing for a hand that holds on through it', () => {
    const { guard, request, run, now } = setUp();
    guard.requestLease('ada', false, 0);
    const { lease = '' } = guard.leaseState('ada');
    let sequence = 0;
    const ask = (x: number) => {
      const twist: Twist = { ...zeroTwist(), linear: { x, y: 0, z: 0 } };
      const command: Command = {
        type: 'command',
        sequence: ++sequence,
        timeMs: now(),
        lease,
        deadMan: x !== 0,
        twist,
      };
      return guard.onCommand('ada', command, now());
    };
    guard.onOpenHand('ada');
    expect(ask(0.3)).toMatchObject({ accepted: false, reason: 'estop-latched' });
    request.make();
    expect(run(250)).toBe(true);
    expect(ask(0.3)).toMatchObject({ accepted: false });
    run(25);
    ask(0);
    run(25);
    expect(ask(0.3)).toMatchObject({ accepted: true });
  });
});

it('a robot that starts forgets a request from before', () => {
  const request = new ReleaseRequest(folder, 'robot-1');
  request.make();
  const journal = new EstopJournal(folder, 'robot-1', () => undefined);
  expect(journal.request.take()).toBe(false);
});
