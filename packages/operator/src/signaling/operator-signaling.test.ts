import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { SignalingState } from '../link/robot-link.ts';
import { OperatorSignaling, type SessionSignal } from './operator-signaling.ts';

class Bench {
  readonly calls: string[] = [];
  readonly sent: unknown[] = [];
  readonly states: SignalingState[] = [];
  readonly sessions: SessionSignal[] = [];
  robots: readonly { id: string }[] = [];
  faults = 0;
  timerMs = 0;
  readonly machine: OperatorSignaling;

  constructor(token?: string) {
    this.machine = new OperatorSignaling(
      { name: 'Ada', token },
      {
        open: () => this.calls.push('open'),
        close: () => this.calls.push('close'),
        send: (text) => this.sent.push(JSON.parse(text)),
        setTimer: (ms) => {
          this.timerMs = ms;
        },
      },
      {
        onState: (state) => this.states.push(state),
        onRobots: (robots) => {
          this.robots = robots;
        },
        onSession: (message) => this.sessions.push(message),
        onFault: () => {
          this.faults++;
        },
      },
      () => 0.5,
    );
  }

  receive(message: unknown): void {
    this.machine.onMessage(JSON.stringify(message));
  }

  ready(): this {
    this.machine.start();
    this.machine.onOpen();
    this.receive({ type: 'operator.welcome', iceServers: [{ urls: 'stun:a' }] });
    return this;
  }
}

describe('OperatorSignaling', () => {
  test('says hello, is welcomed and receives the list', () => {
    const bench = new Bench('secret').ready();
    expect(bench.sent).toEqual([{ type: 'operator.hello', protocol: 1, name: 'Ada', token: 'secret' }]);
    expect(bench.machine.iceServers).toEqual([{ urls: 'stun:a' }]);
    bench.receive({ type: 'robots', robots: [{ id: 'r', name: 'R' }] });
    expect(bench.robots).toEqual([{ id: 'r', name: 'R' }]);
    bench.receive({ type: 'robots.changed', here: [{ id: 's', name: 'S' }], gone: ['r'] });
    expect(bench.robots).toEqual([{ id: 's', name: 'S' }]);
    bench.receive({ type: 'robots', robots: [] });
    expect(bench.robots).toEqual([]);
    expect(bench.states).toEqual(['connecting', 'ready']);
  });

  test('is told what robots say about themselves while it looks, and knows nothing without the service', () => {
    const status = { state: 'free', sinceMs: 0, operators: 0, watchers: 0, maxOperators: 4, alarms: 0 };
    const bench = new Bench().ready();
    bench.sent.length = 0;
    bench.machine.watchStatuses(true);
    bench.machine.watchStatuses(true);
    expect(bench.sent).toEqual([{ type: 'statuses.watch', on: true }]);
    bench.receive({ type: 'statuses', statuses: [{ id: 'r', status }] });
    bench.receive({ type: 'statuses.changed', here: [{ id: 's', status }], gone: [] });
    expect([...bench.machine.statuses.keys()]).toEqual(['r', 's']);
    const stopped = { ...status, state: 'stopped' };
    bench.receive({ type: 'statuses.changed', here: [{ id: 's', status: stopped }], gone: ['r'] });
    expect([...bench.machine.statuses]).toEqual([['s', stopped]]);
    bench.machine.onClose();
    expect(bench.machine.statuses.size).toBe(0);
    // It asks again by itself.
    bench.sent.length = 0;
    bench.machine.retryNow();
    bench.machine.onOpen();
    bench.receive({ type: 'operator.welcome', iceServers: [] });
    expect(bench.sent.at(-1)).toEqual({ type: 'statuses.watch', on: true });
    bench.receive({ type: 'statuses', statuses: [{ id: 'r', status }] });
    bench.machine.watchStatuses(false);
    expect(bench.machine.statuses.size).toBe(0);
    // What was on its way is not kept.
    bench.receive({ type: 'statuses.changed', here: [{ id: 'r', status }], gone: [] });
    expect(bench.machine.statuses.size).toBe(0);
  });

  test('keeps from the operator that an older service does not know statuses', () => {
    const bench = new Bench().ready();
    bench.machine.watchStatuses(true);
    const error = { type: 'error', code: 'malformed', message: 'not a message' };
    bench.receive(error);
    expect(bench.sessions).toEqual([]);
    bench.receive(error);
    expect(bench.sessions).toEqual([error]);
  });

  test('knows where operators sign in, as long as the service says so', () => {
    const bench = new Bench().ready();
    expect(bench.machine.signInUrl).toBeNull();
    const signIn = 'https://issuer.example/sign-in';
    bench.receive({ type: 'operator.welcome', iceServers: [], signIn });
    expect(bench.machine.signInUrl).toBe(signIn);
    bench.receive({ type: 'operator.welcome', iceServers: [] });
    expect(bench.machine.signInUrl).toBeNull();
  });

  test('sends only when welcomed', () => {
    const bench = new Bench();
    bench.machine.start();
    expect(bench.machine.send({ type: 'session.open', robotId: 'r' })).toBe(false);
    bench.ready();
    expect(bench.machine.send({ type: 'session.open', robotId: 'r' })).toBe(true);
    expect(bench.sent.at(-1)).toEqual({ type: 'session.open', robotId: 'r' });
  });

  test('reconnects without end, within about a second, and fast again after a welcome', () => {
    const bench = new Bench();
    bench.machine.start();
    const waits: number[] = [];
    for (let i = 0; i < 8; i++) {
      bench.machine.onClose();
      expect(bench.machine.state).toBe('waiting');
      waits.push(bench.timerMs);
      bench.machine.onTimer();
      expect(bench.machine.state).toBe('connecting');
    }
    expect(waits).toEqual([250, 500, 800, 800, 800, 800, 800, 800]);
    bench.machine.onOpen();
    bench.receive({ type: 'operator.welcome', iceServers: [] });
    bench.machine.onClose();
    expect(bench.timerMs).toBe(250);
  });

  test('gives up a service that sends no welcome, and tries again', () => {
    const bench = new Bench();
    bench.machine.start();
    bench.machine.onOpen();
    expect(bench.timerMs).toBe(2500);
    bench.machine.onTimer();
    expect(bench.calls).toEqual(['open', 'close']);
    expect(bench.machine.state).toBe('waiting');
  });

  test('reconnects if a request gets no answer', () => {
    const bench = new Bench().ready();
    const question = { type: 'session.resume', session: 's', robotId: 'r', resumeKey: 'k' } as const;
    // The timer of the welcome has no effect any more.
    bench.machine.onTimer();
    expect(bench.machine.state).toBe('ready');
    bench.machine.ask(question);
    bench.receive({ type: 'session.resuming', session: 's' });
    bench.machine.onTimer();
    expect(bench.machine.state).toBe('ready');
    bench.machine.ask(question);
    expect(bench.timerMs).toBe(2000);
    bench.machine.onTimer();
    expect(bench.machine.state).toBe('connecting');
    expect(bench.calls).toEqual(['open', 'close', 'open']);
  });

  test('reports a refused token, and tries again slowly or on request', () => {
    const bench = new Bench('wrong');
    bench.machine.start();
    bench.machine.onOpen();
    bench.receive({ type: 'error', code: 'unauthorized', message: 'no' });
    expect(bench.machine.state).toBe('refused');
    expect(bench.timerMs).toBe(30_000);
    bench.machine.onClose();
    expect(bench.machine.state).toBe('refused');
    bench.machine.retryNow();
    expect(bench.machine.state).toBe('connecting');
  });

  test('does nothing after it is stopped', () => {
    const bench = new Bench().ready();
    bench.machine.stop();
    bench.machine.onClose();
    bench.machine.onTimer();
    expect(bench.machine.state).toBe('stopped');
    expect(bench.calls).toEqual(['open', 'close']);
  });

  test('never throws for anything received over the socket', () => {
    const bench = new Bench().ready();
    fc.assert(
      fc.property(fc.oneof(fc.string(), fc.json()), (text) => {
        bench.machine.onMessage(text);
      }),
      { seed: 3 },
    );
    bench.machine.onMessage('{"type":"robots","robots":[{"id":"UPPER","name":"x"}]}');
    expect(bench.faults).toBeGreaterThan(0);
    expect(bench.machine.state).toBe('ready');
  });
});
