import { decodeJson, type RobotStatus, serviceToOperatorCodec } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { AccessList } from './access.ts';
import { FarpointHub } from './farpoint-hub.ts';
import type { RobotEntry } from './robot-registry.ts';
import { RobotStatuses } from './robot-statuses.ts';
import { FakeClient, FakeClock, FakePeer, type Json, RecordingObserver } from './test-support.ts';

const STATUS = { state: 'free', sinceMs: 0, operators: 0, watchers: 0, maxOperators: 4, alarms: 0 } as const;
/** An operator is told twice a second at most. */
const INTERVAL_MS = 500;

function setup() {
  const clock = new FakeClock();
  const observer = new RecordingObserver();
  const hub = new FarpointHub({
    clock,
    observer,
    listIntervalMs: 100,
    listBytesPerSecond: 1e9,
    signInUrl: null,
    limits: {
      maxMessageBytes: 4096,
      messagesPerSecond: 10,
      messageBurst: 20,
      maxFaults: 5,
      maxRobots: 3,
      maxSessionsPerOperator: 2,
      maxSessionsPerRobot: 2,
      helloTimeoutMs: 1000,
      relayBytesPerSecond: 250_000,
      relayMessagesPerSecond: 200,
    },
    access: () => ({ robots: new AccessList(null), operators: new AccessList(null) }),
    iceServers: () => [],
    makeHandle: () => 's',
  });
  const robot = (id: string): FakeClient => {
    const client = new FakeClient((peer) => hub.robot(peer));
    client.send({ type: 'robot.hello', protocol: 1, id, name: `Robot ${id}`, key: `key-${id}` });
    return client;
  };
  const operator = (): FakeClient => {
    const client = new FakeClient((peer) => hub.operator(peer));
    client.send({ type: 'operator.hello', protocol: 1, name: 'Ada' });
    return client;
  };
  const watcher = (): FakeClient => {
    const client = operator();
    client.send({ type: 'statuses.watch', on: true });
    clock.advance(INTERVAL_MS);
    return client;
  };
  const say = (from: FakeClient, status: Json = {}) =>
    from.send({ type: 'robot.status', status: { ...STATUS, ...status } });
  const told = (to: FakeClient) => to.take().filter(({ type }) => String(type).startsWith('statuses'));
  return { clock, observer, robot, operator, watcher, say, told };
}

describe('what robots say about themselves', () => {
  test('goes to whoever looks at the list, whole and then its changes, and to nobody else', () => {
    const { clock, robot, operator, watcher, say, told } = setup();
    const [one, two] = [robot('r1'), robot('r2')];
    say(one, { battery: 0.5 });
    const [looks, plain] = [watcher(), operator()];
    expect(told(looks)).toEqual([
      { type: 'statuses', statuses: [{ id: 'r1', status: { ...STATUS, battery: 0.5 } }] },
    ]);
    say(two, { state: 'driven', driver: 'Bob' });
    clock.advance(INTERVAL_MS);
    expect(told(looks)).toEqual([
      {
        type: 'statuses.changed',
        here: [{ id: 'r2', status: { ...STATUS, state: 'driven', driver: 'Bob' } }],
        gone: [],
      },
    ]);
    looks.send({ type: 'statuses.watch', on: false });
    say(one, { state: 'stopped' });
    clock.advance(INTERVAL_MS);
    expect([told(looks), told(plain)]).toEqual([[], []]);
    // Once more: the whole list.
    looks.send({ type: 'statuses.watch', on: true });
    clock.advance(INTERVAL_MS);
    expect(told(looks)).toMatchObject([{ type: 'statuses', statuses: [{ id: 'r1' }, { id: 'r2' }] }]);
  });

  test('is passed on twice a second at most, the newest of each', () => {
    const { clock, robot, watcher, say, told } = setup();
    const one = robot('r1');
    const looks = watcher();
    told(looks);
    clock.advance(INTERVAL_MS);
    say(one, { operators: 1 });
    clock.advance(0);
    expect(told(looks)).toMatchObject([{ here: [{ status: { operators: 1 } }] }]);
    for (const operators of [2, 3, 4]) say(one, { operators });
    clock.advance(INTERVAL_MS - 1);
    expect(told(looks)).toEqual([]);
    clock.advance(1);
    expect(told(looks)).toMatchObject([{ here: [{ status: { operators: 4 } }] }]);
  });

  test('is sent whole once in that time, however often it is asked for', () => {
    const { clock, robot, watcher, say, told } = setup();
    say(robot('r1'));
    const looks = watcher();
    told(looks);
    for (let i = 0; i < 4; i++) {
      looks.send({ type: 'statuses.watch', on: false });
      looks.send({ type: 'statuses.watch', on: true });
    }
    clock.advance(INTERVAL_MS);
    expect(told(looks)).toHaveLength(1);
    looks.send({ type: 'statuses.watch', on: true });
    clock.advance(INTERVAL_MS);
    expect(told(looks)).toEqual([]);
  });

  test('is refused when a robot says it too often, and what was said before stays', () => {
    const { clock, observer, robot, watcher, say, told } = setup();
    const one = robot('r1');
    for (let operators = 1; operators <= 6; operators++) say(one, { operators });
    expect(one.take().at(-1)).toMatchObject({ type: 'error', code: 'rate-limited' });
    expect(observer.rejects).toEqual(['robot: rate-limited']);
    expect(told(watcher())).toMatchObject([{ statuses: [{ status: { operators: 5 } }] }]);
    clock.advance(1000);
    say(one, { operators: 7 });
    expect(observer.rejects).toHaveLength(1);
  });

  test('is forgotten when the robot leaves, and when a newer connection of it takes over', () => {
    const { clock, robot, watcher, say, told } = setup();
    const one = robot('r1');
    say(one);
    const looks = watcher();
    told(looks);
    const newer = robot('r1');
    clock.advance(INTERVAL_MS);
    expect(told(looks)).toEqual([{ type: 'statuses.changed', here: [], gone: ['r1'] }]);
    say(newer);
    one.connection.closed();
    clock.advance(INTERVAL_MS);
    expect(told(looks)).toMatchObject([{ here: [{ id: 'r1' }], gone: [] }]);
    newer.connection.closed();
    clock.advance(INTERVAL_MS);
    expect(told(looks)).toMatchObject([{ here: [], gone: ['r1'] }]);
  });

  test.each<[string, Json]>([
    ['a battery of more than all', { battery: 1.5 }],
    ['a state that nobody knows', { state: 'asleep' }],
    ['a driver without a name', { driver: '' }],
    ['what nobody has asked for', { picture: 'data:image/png;base64,' }],
  ])('is refused with %s, and what was said before stays', (_, wrong) => {
    const { observer, robot, watcher, say, told } = setup();
    const one = robot('r1');
    say(one, { battery: 0.5 });
    say(one, wrong);
    expect(one.types().at(-1)).toBe('malformed');
    expect(observer.rejects).toEqual(['robot: malformed']);
    expect(told(watcher())).toMatchObject([{ statuses: [{ status: { battery: 0.5 } }] }]);
  });

  test('is asked for by operators only, and a robot can speak for itself only', () => {
    const { robot, operator, say } = setup();
    const [one, ada] = [robot('r1'), operator()];
    one.take();
    ada.take();
    one.send({ type: 'statuses.watch', on: true });
    say(ada);
    one.send({ type: 'robot.status', id: 'r2', status: STATUS });
    expect([one.types(), ada.types()]).toEqual([['malformed', 'malformed'], ['malformed']]);
  });
});

test('the longest list, of as many robots as there may be, fits what operators accept', () => {
  const statuses = new RobotStatuses();
  const status: RobotStatus = {
    state: 'stopped',
    sinceMs: 8.64e15,
    battery: 0.123456789012345,
    // Each of these takes three bytes, as does half a surrogate pair once it has been replaced.
    driver: `${'字'.repeat(63)}\ud800`,
    operators: 1_000_000,
    watchers: 1_000_000,
    maxOperators: 1_000_000,
    alarms: 1_000_000,
    version: 'x'.repeat(32),
  };
  for (let i = 0; i < 4900; i++) {
    const robot: RobotEntry = { id: `${i}`.padStart(64, 'r'), name: 'R', key: 'k', peer: new FakePeer() };
    statuses.set(robot, status, 0);
  }
  const whole = statuses.listing.whole();
  expect(decodeJson(serviceToOperatorCodec, whole)).toMatchObject({ type: 'statuses' });
  expect(new TextDecoder().decode(whole)).not.toContain('\\ud800');
});
