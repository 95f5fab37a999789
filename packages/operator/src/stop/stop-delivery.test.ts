import type { EstopState, OperatorControlMessage, OperatorSessionMessage } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { SessionPhase } from '../session/session-keeper.ts';
import { STOP_KEPT_MS, StopDelivery, type StopLink, type StopStatus } from './stop-delivery.ts';

/** A link to a robot that numbers its latches, unless `latch` is left out of what it says first. */
function setUp(first: EstopState = { type: 'estop', latched: false, latch: 0 }) {
  const session: OperatorSessionMessage[] = [];
  const control: OperatorControlMessage[] = [];
  const statuses: StopStatus[] = [];
  const link = {
    ...{ phase: 'live' as SessionPhase, interrupted: false, robotId: 'rover' as string | null },
    session: { estop: first } as StopLink['session'],
    sendSession: (message: OperatorSessionMessage) => void session.push(message),
    sendControl: (message: OperatorControlMessage) => void control.push(message),
  };
  const stops = new StopDelivery(link, (status) => statuses.push(status));
  const newSession = (estop = first) => {
    link.session = { estop } as StopLink['session'];
    stops.onSession();
  };
  return { link, stops, session, control, statuses, newSession };
}

const unnumbered: EstopState = { type: 'estop', latched: false };

describe('a press of STOP', () => {
  it('is sent on both channels at once, and repeated on control until it is acknowledged', () => {
    const { stops, session, control, statuses } = setUp();
    expect(stops.press(0)).toBe(true);
    for (let t = 0; t < 200; t += 25) stops.sendDue(t);
    expect(session).toEqual([{ type: 'estop', latch: true, press: 1 }]);
    expect(control).toEqual(Array(4).fill({ type: 'estop', press: 1 }));
    stops.onAck(1);
    stops.sendDue(1000);
    expect(control).toHaveLength(4);
    expect(statuses).toEqual(['unconfirmed', 'confirmed']);
  });

  it('is confirmed by the robot’s state if that names the press, and not by an older latch', () => {
    const { stops } = setUp();
    stops.press(0);
    stops.onState({ type: 'estop', latched: true, by: 'operator', latch: 3 });
    stops.onAck(0);
    expect(stops.status).toBe('unconfirmed');
    stops.onState({ type: 'estop', latched: true, by: 'operator', latch: 4, press: 1 });
    expect(stops.status).toBe('confirmed');
    // Sent before the press, and overtaken by the acknowledgement.
    stops.onState({ type: 'estop', latched: false, latch: 3 });
    expect(stops.status).toBe('confirmed');
    stops.onState({ type: 'estop', latched: false, latch: 4, press: 1 });
    expect(stops.status).toBe('none');
  });

  it('while nothing is heard, still goes out, but seldom', () => {
    const { stops, control, link } = setUp();
    link.interrupted = true;
    stops.press(0);
    for (let t = 0; t < 2000; t += 25) stops.sendDue(t);
    expect(control).toHaveLength(4);
  });

  it('without a session is kept, and sent in the next one', () => {
    const { stops, session, control, link, newSession } = setUp();
    link.phase = 'waiting';
    expect(stops.press(0)).toBe(true);
    stops.sendDue(30_000);
    expect([...session, ...control]).toEqual([]);
    newSession();
    link.phase = 'live';
    stops.sendDue(30_025);
    expect(session).toHaveLength(1);
    expect(control).toHaveLength(1);
    // This session is lost too, before the acknowledgement.
    newSession();
    stops.sendDue(30_050);
    expect(session).toHaveLength(2);
    expect(stops.status).toBe('unconfirmed');
  });

  it('is given up after a minute, and the operator is told', () => {
    const { stops, session, link } = setUp();
    link.phase = 'waiting';
    stops.press(0);
    stops.sendDue(STOP_KEPT_MS - 1);
    expect(stops.status).toBe('unconfirmed');
    stops.sendDue(STOP_KEPT_MS);
    expect(stops.status).toBe('undelivered');
    link.phase = 'live';
    stops.sendDue(STOP_KEPT_MS + 25);
    expect(session).toEqual([]);
    stops.press(STOP_KEPT_MS + 50);
    expect(session).toEqual([{ type: 'estop', latch: true, press: 2 }]);
  });

  it('stops no robot but the one it was meant for', () => {
    const { stops, session, link } = setUp();
    link.phase = 'waiting';
    stops.press(0);
    link.robotId = 'other';
    link.phase = 'live';
    stops.sendDue(25);
    expect(session).toEqual([]);
    expect(stops.status).toBe('undelivered');
    link.robotId = null;
    expect(stops.press(50)).toBe(false);
  });

  it('to a robot that does not number latches is plain, and confirmed by its being latched', () => {
    const { stops, session, control } = setUp(unnumbered);
    stops.press(0);
    for (let t = 0; t < 200; t += 25) stops.sendDue(t);
    expect(session).toEqual([{ type: 'estop', latch: true }]);
    expect(control).toEqual([]);
    stops.onState({ type: 'estop', latched: true, by: 'operator' });
    expect(stops.status).toBe('confirmed');
    stops.onState(unnumbered);
    expect(stops.status).toBe('none');
  });

  it('is sent plain before the robot has said anything, then with its number', () => {
    const { stops, session, link } = setUp(unnumbered);
    stops.press(0);
    const { session: opened } = link;
    opened.estop = { type: 'estop', latched: true, by: 'operator', latch: 1 };
    stops.onState(opened.estop);
    expect(stops.status).toBe('unconfirmed');
    stops.sendDue(25);
    expect(session).toEqual([
      { type: 'estop', latch: true },
      { type: 'estop', latch: true, press: 1 },
    ]);
  });
});

/** Acts on presses as the robot does (docs/protocol.md), and keeps in order what the reliable channel carries. */
class Robot {
  latch = 0;
  latched = false;
  newest: number | null = null;

  take(press: number | undefined): void {
    if (press !== undefined) {
      if (this.newest !== null && press <= this.newest) return;
      this.newest = press;
    }
    this.latch++;
    this.latched = true;
  }

  get state(): EstopState {
    const press = this.newest === null ? {} : { press: this.newest };
    return this.latched
      ? { type: 'estop', latched: true, by: 'operator', latch: this.latch, ...press }
      : { type: 'estop', latched: false, latch: this.latch, ...press };
  }
}

it('whatever is lost, repeated, overtaken or cut: confirms only what has latched, and everything once the link holds', () => {
  const step = fc.oneof(
    { weight: 3, arbitrary: fc.record({ kind: fc.constant('press' as const) }) },
    { weight: 4, arbitrary: fc.record({ kind: fc.constantFrom('cut', 'restored', 'new-session', 'lost') }) },
    { weight: 6, arbitrary: fc.record({ kind: fc.constant('deliver' as const), pick: fc.nat(20) }) },
    { weight: 2, arbitrary: fc.record({ kind: fc.constantFrom('drop', 'repeat'), pick: fc.nat(20) }) },
    { weight: 6, arbitrary: fc.record({ kind: fc.constant('wait' as const), ms: fc.nat(300) }) },
  );
  let confirmed = 0;
  let kept = 0;
  fc.assert(
    fc.property(fc.array(step, { maxLength: 80, size: 'max' }), (steps) => {
      const robot = new Robot();
      const { link, stops, newSession } = setUp();
      let nowMs = 0;
      let presses = 0;
      /** On their way. Of `reliable`, only the first may arrive next, and nothing is lost within a session. */
      let reliable: (() => void)[] = [];
      const loose: (() => void)[] = [];
      const tell = () => {
        const { state } = robot;
        reliable.push(() => {
          link.session.estop = state;
          stops.onState(state);
        });
      };
      link.sendSession = (message) => {
        if (message.type !== 'estop') return;
        const { press } = message;
        reliable.push(() => {
          robot.take(press);
          tell();
        });
      };
      link.sendControl = (message) => {
        if (message.type !== 'estop') return;
        const { press } = message;
        const { session } = link;
        loose.push(() => {
          // Packets of a session that is over reach nobody.
          if (session !== link.session) return;
          robot.take(press);
          loose.push(() => session === link.session && stops.onAck(press));
        });
      };
      const begin = () => {
        reliable = [];
        robot.newest = null;
        newSession({ type: 'estop', latched: false });
        tell();
        link.phase = 'live';
        link.interrupted = false;
      };
      const deliver = (pick: number) => {
        if (link.phase !== 'live' || link.interrupted) return;
        const n = pick % (loose.length + 1);
        if (n === loose.length) reliable.shift()?.();
        else loose.splice(n, 1)[0]?.();
      };
      for (const each of steps) {
        if (each.kind === 'press') {
          stops.press(nowMs);
          presses++;
          if (link.phase !== 'live') kept++;
        } else if (each.kind === 'cut') link.interrupted = true;
        else if (each.kind === 'restored') link.interrupted = false;
        else if (each.kind === 'lost') link.phase = 'waiting';
        else if (each.kind === 'new-session') begin();
        else if (each.kind === 'deliver') deliver(each.pick);
        else if (each.kind === 'drop') loose.splice(each.pick % (loose.length + 1), 1);
        else if (each.kind === 'repeat') {
          const copy = loose[each.pick % (loose.length + 1)];
          if (copy !== undefined) loose.push(copy);
        } else if (each.kind === 'wait') {
          nowMs += each.ms;
          stops.sendDue(nowMs);
        }
        if (stops.status === 'confirmed') expect(robot.latched).toBe(true);
      }
      // From now on the link holds.
      if (link.phase !== 'live') begin();
      link.interrupted = false;
      for (let i = 0; i < 200; i++) {
        nowMs += 25;
        stops.sendDue(nowMs);
        deliver(loose.length);
        while (loose.length > 0) deliver(0);
      }
      if (presses === 0) return;
      expect(robot.latched).toBe(true);
      // `none`: confirmed in an earlier session.
      expect(stops.status).not.toBe('unconfirmed');
      if (stops.status === 'confirmed') confirmed++;
    }),
    { seed: 47, numRuns: 400 },
  );
  expect(confirmed).toBeGreaterThan(50);
  expect(kept).toBeGreaterThan(50);
});
