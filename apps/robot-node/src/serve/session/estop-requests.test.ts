import type { DriveGuardOptions } from '@farpoint/safety';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { sessionRobot } from './testing/session-robot.ts';

function robot(options: Partial<DriveGuardOptions> = {}) {
  const made = sessionRobot(options);
  function operator(id: string) {
    const joined = made.operator(id);
    const { inbox, session, send } = joined;
    session.sendEstop();
    return {
      ...joined,
      drive: () => send({ type: 'leaseRequest', take: true }),
      pressOnSession: (press?: number) => send({ type: 'estop', latch: true, press }),
      pressOnControl: (press: number) => send({ type: 'estop', press }, 'control'),
      release: (of?: number) => send({ type: 'estop', latch: false, of }),
      lastFault: () => inbox.findLast((message) => message.type === 'fault')?.reason,
    };
  }
  return { ...made, operator, latched: () => made.guard.estopState().latched };
}

describe('STOP on two channels', () => {
  it('counts once, whichever comes first, and is acknowledged on both', () => {
    const { operator, guard, latched } = robot();
    const a = operator('a');
    a.pressOnControl(1);
    expect(latched()).toBe(true);
    expect(a.control.map((text) => JSON.parse(text))).toEqual([{ type: 'estopAck', press: 1 }]);
    a.pressOnSession(1);
    a.pressOnControl(1);
    expect(guard.estopState().latch).toBe(1);
    expect(a.inbox.at(-1)).toMatchObject({ latched: true, latch: 1, press: 1 });
    expect(a.control).toHaveLength(2);
  });

  it('reaches the robot through a flood of commands', () => {
    const { operator, latched } = robot();
    const a = operator('a');
    const probe = JSON.stringify({ type: 'clockProbe', id: 1, sentMs: 0 });
    for (let n = 0; n < 5000; n++) a.session.onMessage('control', probe);
    a.pressOnControl(1);
    expect(latched()).toBe(true);
  });
});

describe('a release', () => {
  it('that names none counts a second after the operator was told of the latch, no sooner', () => {
    const { operator, latched, pass } = robot();
    const [a, b] = [operator('a'), operator('b')];
    a.drive();
    b.pressOnSession();
    pass(999);
    a.release();
    expect(latched()).toBe(true);
    expect(a.lastFault()).toBe('newer-latch');
    // The second press starts the time anew.
    b.pressOnSession();
    pass(1);
    a.release();
    expect(latched()).toBe(true);
    pass(999);
    a.release();
    expect(latched()).toBe(false);
  });

  it('by the policy latcher is for those who pressed, all of them, until they have left', () => {
    const { operator, latched, guard, refused } = robot({ estopRelease: 'latcher' });
    const [a, b] = [operator('a'), operator('b')];
    a.drive();
    a.pressOnSession(1);
    b.pressOnSession(1);
    a.release(2);
    expect(latched()).toBe(true);
    expect(a.lastFault()).toBe('not-latcher');
    a.release(2);
    expect(refused).toEqual(['estop-release others-latched', 'estop-release not-latcher']);
    guard.operatorGone('b');
    a.release(2);
    expect(latched()).toBe(false);
  });

  it('by the policy supervisor is for supervisors, unless only the robot has latched', () => {
    const { operator, latched, guard } = robot({ estopRelease: 'supervisor' });
    const [a, s] = [operator('a'), operator('s')];
    s.session.access = { ...s.session.access, role: 'supervise' };
    a.session.access = { ...a.session.access, role: 'drive' };
    a.drive();
    guard.latchEstop('robot');
    a.release(1);
    expect(latched()).toBe(false);
    guard.latchEstop('robot');
    a.pressOnSession(1);
    expect(guard.estopKeptFor).toBe('operator');
    a.release(3);
    expect(latched()).toBe(true);
    expect(a.lastFault()).toBe('not-permitted');
    s.release(3);
    expect(latched()).toBe(false);
  });
});

it('whatever is lost, repeated or overtakes: no press that arrived is undone except by a release that knew of it', () => {
  const step = fc.oneof(
    fc.record({
      kind: fc.constant('press' as const),
      by: fc.constantFrom(0, 1),
      /** Where copies of this press arrive, and after how many further steps. */
      copies: fc.array(fc.record({ channel: fc.constantFrom('session', 'control'), after: fc.nat(8) }), {
        maxLength: 4,
      }),
    }),
    fc.record({ kind: fc.constant('release' as const), by: fc.constantFrom(0, 1), after: fc.nat(8) }),
    fc.record({ kind: fc.constant('wait' as const), ms: fc.constantFrom(1, 50, 500, 2000) }),
  );
  let released = 0;
  let refusedOld = 0;
  fc.assert(
    fc.property(fc.array(step, { maxLength: 60, size: 'max' }), (steps) => {
      const { operator, guard, latched, pass } = robot();
      const both = [operator('a'), operator('b')] as const;
      const presses = [0, 0];
      const arrived = [new Set<number>(), new Set<number>()];
      const due: { at: number; run: () => void }[] = [];
      for (const [now, each] of [...steps, ...Array(9).fill(null)].entries()) {
        if (each?.kind === 'wait') pass(each.ms);
        if (each?.kind === 'press') {
          const { by } = each;
          const press = ++presses[by]!;
          for (const { channel, after } of each.copies) {
            const run = () => {
              const isNew = [...arrived[by]!].every((earlier) => earlier < press);
              const before = guard.estopState();
              if (channel === 'session') both[by as 0].pressOnSession(press);
              else both[by as 0].pressOnControl(press);
              arrived[by]!.add(press);
              // A new press latches; a repeat, or one that was overtaken, changes nothing.
              if (isNew) expect(latched()).toBe(true);
              else expect(guard.estopState()).toEqual(before);
            };
            due.push({ at: now + after, run });
          }
        }
        if (each?.kind === 'release') {
          const { by } = each;
          both[by as 0].drive();
          // What the operator knows when it lets go of the release control.
          const known = both[by as 0].inbox.findLast((message) => message.type === 'estop');
          const run = () => {
            both[by as 0].drive();
            const before = guard.estopState();
            const holds = guard.leaseHolder === (by === 0 ? 'a' : 'b');
            both[by as 0].release(known?.latch);
            const isOld = known?.latch !== before.latch;
            if (before.latched && !latched()) {
              expect(holds && !isOld).toBe(true);
              released++;
            } else if (before.latched && isOld) refusedOld++;
          };
          due.push({ at: now + each.after, run });
        }
        for (const { run } of due.filter(({ at }) => at === now)) run();
      }
    }),
    { seed: 31, numRuns: 300 },
  );
  expect(released).toBeGreaterThan(100);
  expect(refusedOld).toBeGreaterThan(100);
});
