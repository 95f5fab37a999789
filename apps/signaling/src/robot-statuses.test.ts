import { describe, expect, test } from 'vitest';
import { AccessList } from './access.ts';
import { FarpointHub } from './farpoint-hub.ts';
import { FakeClient, FakeClock, type Json, RecordingObserver } from './test-support.ts';

const STATUS = { estop: false, moving: false, driven: false, operators: 0, maxOperators: 4, alarms: 0 };
const INTERVAL_MS = 100;

function setup() {
  const clock = new FakeClock();
  const observer = new RecordingObserver();
  const hub = new FarpointHub({
    ...{ clock, observer, listIntervalMs: INTERVAL_MS, listBytesPerSecond: 1e9, signInUrl: () => null },
    limits: {
      ...{ maxMessageBytes: 4096, messagesPerSecond: 10, messageBurst: 20, maxFaults: 5, maxRobots: 3 },
      ...{ maxSessionsPerOperator: 2, maxSessionsPerRobot: 2, helloTimeoutMs: 1000 },
    },
    access: () => ({ robots: new AccessList(null), operators: new AccessList(null) }),
    iceServers: () => [],
    makeHandle: () => 's',
  });
  const robot = (id: string, key = `key-${id}`): FakeClient => {
    const client = new FakeClient((peer) => hub.robot(peer));
    client.send({ type: 'robot.hello', protocol: 1, id, name: `Robot ${id}`, key });
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
    say(two, { driven: true, driver: 'Bob' });
    clock.advance(INTERVAL_MS);
    expect(told(looks)).toEqual([
      {
        type: 'statuses.changed',
        here: [{ id: 'r2', status: { ...STATUS, driven: true, driver: 'Bob' } }],
        gone: [],
      },
    ]);
    looks.send({ type: 'statuses.watch', on: false });
    say(one, { estop: true });
    clock.advance(INTERVAL_MS);
    expect([told(looks), told(plain)]).toEqual([[], []]);
    // Once more: the whole list.
    looks.send({ type: 'statuses.watch', on: true });
    expect(told(looks)).toMatchObject([{ type: 'statuses', statuses: [{ id: 'r1' }, { id: 'r2' }] }]);
  });

  test('is said once in an interval, the newest of each', () => {
    const { clock, robot, watcher, say, told } = setup();
    const one = robot('r1');
    const looks = watcher();
    clock.advance(INTERVAL_MS);
    told(looks);
    say(one, { operators: 1 });
    clock.advance(0);
    told(looks);
    for (const operators of [2, 3, 4]) say(one, { operators });
    clock.advance(INTERVAL_MS);
    expect(told(looks)).toMatchObject([{ here: [{ status: { operators: 4 } }] }]);
  });

  test('is forgotten when the robot leaves, and when a newer connection of it takes over', () => {
    const { clock, robot, watcher, say, told } = setup();
    const one = robot('r1');
    say(one);
    const looks = watcher();
    clock.advance(INTERVAL_MS);
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
    ['a battery that is no number', { battery: 'full' }],
    ['a driver without a name', { driver: '' }],
    ['fewer operators than none', { operators: -1 }],
    ['what nobody has asked for', { picture: 'data:image/png;base64,' }],
  ])('is refused with %s, and what was said before stays', (_, wrong) => {
    const { clock, observer, robot, watcher, say, told } = setup();
    const one = robot('r1');
    say(one, { battery: 0.5 });
    say(one, wrong);
    expect(one.types().at(-1)).toBe('malformed');
    expect(observer.rejects).toEqual(['robot: malformed']);
    clock.advance(INTERVAL_MS);
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
