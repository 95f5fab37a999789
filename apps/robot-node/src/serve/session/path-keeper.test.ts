import type { RobotToService } from '@farpoint/protocol';
import { silentLogger } from '@farpoint/service';
import { expect, it } from 'vitest';
import { ReasonCounts } from '../../ground/robot-counters.ts';
import type { DriveStation } from '../../motion/drive/drive-station.ts';
import { type KeptOperator, PathKeeper } from './path-keeper.ts';
import { RestartPolicy } from './restart-policy.ts';
import { ResumeKey } from './resume-key.ts';
import { silenceLimits } from './silence.ts';

function setUp(connected = true) {
  let nowMs = 1000;
  const sent: RobotToService[] = [];
  const done: string[] = [];
  const resumeKey = new ResumeKey();
  const drive = {
    guard: {
      releaseLease: (id: string) => {
        const held = leased === id;
        leased = held ? null : leased;
        return held;
      },
    },
    apply: () => done.push('apply'),
  };
  let leased: string | null = 'op';
  const messages = { id: 'op', heardMs: 1000 };
  const operator = {
    ...{ messages, sender: {}, update: () => undefined },
    ...{ resumeKey, restarts: new RestartPolicy(), heardMs: 0 },
    peer: {
      connected,
      close: () => done.push('close'),
      useIceServers: () => done.push('servers'),
      restart: async () => {
        done.push('restart');
        return 'v=0';
      },
    },
  } as unknown as KeptOperator;
  const counters = { iceRestarts: 0, resumesRefused: new ReasonCounts() };
  const operators = new Map([['s', operator]]);
  const keeper = new PathKeeper({
    operators: () => operators,
    limits: silenceLimits(60_000, 3000),
    drive: drive as unknown as DriveStation,
    signaling: {
      send: (message) => {
        sent.push(message);
        return true;
      },
      check: () => undefined,
    },
    leaseChanged: () => done.push('lease changed'),
    counters,
    log: silentLogger(),
    now: () => nowMs,
  });
  const resume = async (key: string, session = 's', claim = 'c') => {
    sent.length = 0;
    await keeper.resume({ type: 'session.resume', session, operator: 'Ada', claim, resumeKey: key }, []);
    return sent[0] ?? null;
  };
  const pass = (ms: number) => {
    nowMs += ms;
  };
  /** The page says something; without it, only ICE or RTCP is heard. */
  const hear = (page: boolean) => {
    Object.assign(operator, { heardMs: nowMs });
    if (page) messages.heardMs = nowMs;
  };
  return { resume, pass, hear, keeper, done, counters, key: resumeKey.text };
}

it('releases the lease of a page that is frozen while ICE and RTCP go on', () => {
  const { keeper, hear, pass, done } = setUp();
  for (let i = 0; i < 100; i++) {
    pass(100);
    hear(true);
    keeper.update();
  }
  expect(done).toEqual([]);
  for (let i = 0; i < 30; i++) {
    pass(100);
    hear(false);
    keeper.update();
  }
  expect(done).toEqual([]);
  pass(1);
  hear(false);
  keeper.update();
  keeper.update();
  expect(done).toEqual(['apply', 'lease changed']);
});

it('restarts ICE for an operator with the right key, and repeats its claim in the offer', async () => {
  const { resume, done, key, counters } = setUp();
  expect(await resume(key)).toEqual({ type: 'session.offer', session: 's', sdp: 'v=0', claim: 'c' });
  expect([done, counters.iceRestarts]).toEqual([['servers', 'restart'], 1]);
});

it('ignores a request with a wrong key, without delaying the real operator’s request', async () => {
  const { resume, done, key, counters } = setUp();
  for (let i = 0; i < 9; i++) {
    expect(await resume(`${key}x`)).toEqual({
      ...{ type: 'session.refuse', session: 's', claim: 'c', code: 'wrong-resume-key' },
    });
  }
  expect(done).toEqual([]);
  expect(counters.resumesRefused.get('wrong-resume-key')).toBe(9);
  expect(await resume(key)).toMatchObject({ type: 'session.offer' });
});

it('says why it does not resume', async () => {
  const { resume, key } = setUp();
  expect(await resume(key, 'other')).toMatchObject({ session: 'other', code: 'unknown-session' });
  await resume(key);
  expect(await resume(key)).toMatchObject({ code: 'resume-too-soon' });
  expect(await setUp(false).resume('0')).toMatchObject({ code: 'wrong-resume-key' });
  const early = setUp(false);
  expect(await early.resume(early.key)).toMatchObject({ code: 'resume-too-soon' });
});

it('answers few of endless requests, because the service limits the rate at which the robot sends', async () => {
  const { resume, pass, counters } = setUp();
  let answers = 0;
  for (let i = 0; i < 1000; i++) {
    if ((await resume('x')) !== null) answers++;
    pass(10);
  }
  expect(answers).toBe(10 + 49);
  expect(counters.resumesRefused.get('wrong-resume-key')).toBe(1000);
});
