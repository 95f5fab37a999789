import { nearFieldText, writePictureChunk } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { RobotSession, type RobotSessionEvents } from './robot-session.ts';

/** A session, and the names of the events that it has told: `lease` for `onLease`. */
function bench(): { session: RobotSession; told: string[] } {
  const told: string[] = [];
  const events = new Proxy({} as RobotSessionEvents, {
    get: (_, name: string) => () => void told.push(name.charAt(2).toLowerCase() + name.slice(3)),
  });
  return { session: new RobotSession(events), told };
}

function telemetry(sequence: number): string {
  const zero = { x: 0, y: 0, z: 0 };
  return JSON.stringify({
    type: 'telemetry',
    sequence,
    timeMs: 1,
    pose: { position: zero, orientation: { ...zero, w: 1 } },
    twist: { linear: zero, angular: zero },
    drive: 'idle',
    stages: { captureMs: 0, sampleMs: 0, packMs: 0, sendMs: 0 },
    stream: {
      frameNumber: 0,
      framesPerSecond: 0,
      pointsPerFrame: 0,
      validPoints: 0,
      bitsPerSecond: 0,
      targetBitsPerSecond: 0,
      droppedFrames: 0,
    },
    operators: 1,
  });
}

describe('RobotSession', () => {
  test('keeps what the robot sends', () => {
    const { session, told } = bench();
    session.onMessage('session', '{"type":"lease","holder":"you","lease":"abc"}', 0);
    session.onMessage('session', '{"type":"estop","latched":true,"by":"robot"}', 0);
    session.onMessage('session', new TextEncoder().encode('{"type":"fault","message":"no"}'), 0);
    session.onMessage('session', '{"type":"about","drives":false,"shows":"files","recorded":true}', 0);
    expect(session.about).toMatchObject({ drives: false, shows: 'files', recorded: true });
    expect(session.lease).toEqual({ type: 'lease', holder: 'you', lease: 'abc' });
    expect(session.estop.latched).toBe(true);
    const videos =
      '[{"name":"Front","mid":"1","codec":"H264"},{"name":"Rear","mid":"2","codec":"VP8","fault":"gone"}]';
    session.onMessage('session', `{"type":"videos","videos":${videos}}`, 0);
    expect(told).toEqual(['lease', 'estop', 'robotFault', 'videos']);
  });

  test('keeps what explains the present emergency stop, and nothing of an older one', () => {
    const { session, told } = bench();
    const cause = { type: 'estopCause', latch: 7, pressedBy: 'Ada', yours: false, release: 'driver' };
    const estop = (latched: boolean, latch: number) =>
      session.onMessage('session', JSON.stringify({ type: 'estop', latched, latch }), 0);
    session.onMessage('session', JSON.stringify(cause), 0);
    estop(true, 7);
    expect(session.estopCause).toEqual(cause);
    estop(true, 8);
    expect(session.estopCause).toBeNull();
    session.onMessage('session', JSON.stringify(cause), 0);
    estop(false, 7);
    expect(session.estopCause).toBeNull();
    expect(told).toEqual(['estop', 'estop', 'estop']);
  });

  test('keeps who has a session', () => {
    const { session, told } = bench();
    expect(session.operators).toBeNull();
    const ada = { number: 3, name: 'Ada', role: 'drive', drives: true, you: true };
    session.onMessage('session', JSON.stringify({ type: 'operators', operators: [ada], more: 2 }), 0);
    expect(session.operators).toEqual({ type: 'operators', operators: [ada], more: 2 });
    expect(told).toEqual(['operators']);
  });

  test('keeps the quantities, the alarms that are raised, and the reports of components', () => {
    const { session, told } = bench();
    const alarm = (number: number, level: string) =>
      `{"type":"alarm","number":${number},"level":"${level}","text":"low","value":1,"limit":2,"unit":"%","sinceMs":3}`;
    session.onMessage(
      'session',
      '{"type":"quantity","number":3,"topic":"/t","field":"data","label":"T","unit":"°C"}',
      0,
    );
    session.onMessage('session', alarm(0, 'warn'), 0);
    session.onMessage('session', alarm(1, 'error'), 0);
    session.onMessage('session', alarm(0, 'ok'), 0);
    expect(session.quantities.get(3)?.unit).toBe('°C');
    expect([...session.alarms.keys()]).toEqual([1]);
    session.onMessage('telemetry', '{"type":"samples","timeMs":5,"samples":[[3,-1,20.5]]}', 0);
    const report = '{"name":"imu","level":"ok","message":"","sinceMs":1}';
    const counts = '{"error":0,"warn":0,"stale":0,"ok":1}';
    const diagnostics = `{"type":"diagnostics","topic":"/d","timeMs":2,"counts":${counts},"reports":[${report}]}`;
    session.onMessage('telemetry', diagnostics, 0);
    expect(session.components.list()).toMatchObject([{ topic: '/d', reports: [{ name: 'imu' }] }]);
    expect(told).toEqual(['quantity', 'alarm', 'alarm', 'alarm', 'samples', 'diagnostics']);
    expect(session.malformed).toBe(0);
  });

  test('keeps what is near the robot, unless it was overtaken', () => {
    const { session, told } = bench();
    expect(session.near.ageMs(0, null)).toBe(null);
    const near = (timeMs: number) =>
      JSON.stringify({
        type: 'nearField',
        timeMs,
        sectors: nearFieldText([{ hit: { kind: 'thing', metres: timeMs / 1000 }, unseen: null }]),
      });
    session.onMessage('telemetry', near(2000), 100);
    session.onMessage('telemetry', near(1000), 110);
    expect(session.near.sectors[0]).toEqual({ hit: { kind: 'thing', metres: 2 }, unseen: null });
    expect(told).toEqual(['nearField']);
    session.onMessage('telemetry', '{"type":"nearField","timeMs":3000,"sectors":"AAAA"}', 120);
    expect(session.malformed).toBe(1);
    // By its arrival; and by the robot's clock, once that is known: it was on its way for 300 ms.
    expect(session.near.ageMs(150, null)).toBe(50);
    expect(session.near.ageMs(150, 2200)).toBe(350);
    // A clock that is estimated a little wrong makes nothing younger than its arrival.
    expect(session.near.ageMs(150, 1890)).toBe(50);
  });

  test('keeps the navigator’s path and map, and how old they are', () => {
    const { session, told } = bench();
    const path = (timeMs: number, ageMs: number) =>
      JSON.stringify({
        type: 'path',
        topic: '/plan',
        timeMs,
        ageMs,
        points: [
          [0, 0],
          [timeMs, 1],
        ],
      });
    session.onMessage('telemetry', path(2000, 40), 100);
    session.onMessage('telemetry', path(1000, 1140), 110);
    // The same, sent again, and this time faster.
    session.onMessage('telemetry', path(2000, 1060), 1110);
    expect(session.plannedPath.points).toEqual([
      [0, 0],
      [2000, 1],
    ]);
    expect(session.plannedPath.ageMs(1110)).toBe(1060);
    const map = {
      ...{ type: 'map', topic: '/map', number: 1, timeMs: 5, ageMs: 0, width: 2, height: 1, cellM: 1 },
      ...{ origin: { x: 0, y: 0, yaw: 0 }, tiles: [[0, btoa('\u0040\u00c0')]] },
    };
    session.onMessage('telemetry', JSON.stringify(map), 2000);
    expect([...session.map.cells]).toEqual([1, 3]);
    session.onMessage('telemetry', JSON.stringify({ ...map, ageMs: 1000 }), 3000);
    expect(told).toEqual(['plannedPath', 'map']);
    session.onMessage('telemetry', JSON.stringify({ ...map, width: 3 }), 3000);
    expect(session.malformed).toBe(1);
  });

  test('ignores telemetry that was overtaken, also across the wrap', () => {
    const { session, told } = bench();
    for (const sequence of [0xffffffff, 0, 0xfffffffe, 0, 1]) {
      session.onMessage('telemetry', telemetry(sequence), 0);
    }
    expect(session.telemetry?.sequence).toBe(1);
    expect(told).toHaveLength(3);
  });

  test('assembles pictures, and tolerates any bytes', () => {
    const { session, told } = bench();
    const chunk = new Uint8Array(1200);
    const header = {
      format: 'jpeg',
      camera: 0,
      width: 4,
      height: 3,
      pictureId: 1,
      captureTimeUs: 5,
    } as const;
    const length = writePictureChunk(header, Uint8Array.from([1, 2, 3]), 0, chunk);
    const message = chunk.slice(0, length).buffer;
    session.onMessage('pictures', message, 0);
    expect(told).toEqual([]);
    session.onMessage('session', '{"type":"cameras","cameras":[{"name":"Front"}]}', 0);
    session.onMessage('pictures', message, 0);
    session.onMessage('pictures', 'text', 0);
    expect(told).toEqual(['cameras', 'picture']);
    expect(session.malformed).toBe(1);
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 1300, size: 'max' }), (bytes) => {
        session.onMessage('pictures', bytes, 0);
      }),
      { seed: 6, numRuns: 500 },
    );
  });

  test('computes the age of timestamps by the robot’s clock', () => {
    const { session } = bench();
    expect(session.ageMs(0, 0)).toBe(null);
    // 10 ms round trip, robot 1000 ms ahead.
    session.onMessage('control', '{"type":"clockAnswer","id":1,"sentMs":100,"robotMs":1105}', 110);
    expect(session.ageMs(1_105_000, 110)).toBeCloseTo(5, 6);
  });

  test('never throws for any bytes on any channel, and counts them', () => {
    const { session } = bench();
    fc.assert(
      fc.property(
        fc.constantFrom('session' as const, 'telemetry' as const, 'control' as const),
        fc.oneof(fc.string(), fc.json(), fc.uint8Array()),
        (channel, data) => session.onMessage(channel, data, 0),
      ),
      { seed: 5 },
    );
    expect(session.malformed).toBeGreaterThan(0);
  });
});
