/** Faults of the thread that publishes velocities: a stand-in for it that ends and hangs, under the real guard. */
import { BroadcastChannel } from 'node:worker_threads';
import { type Command, zeroTwist } from '@farpoint/protocol';
import { topicTableSchema } from '@farpoint/ros';
import { DriveGuard, defaultDriveLimits, MotionSupervisor } from '@farpoint/safety';
import { silentLogger } from '@farpoint/service';
import { eventually } from '@farpoint/service/testing/eventually';
import { describe, expect, it, onTestFinished } from 'vitest';
import { monotonicMs } from '../../ground/clock.ts';
import { DriveStation } from './drive-station.ts';
import { RosSink } from './ros-sink.ts';

const THREAD = new URL('../../testing/ending-drive-worker.ts', import.meta.url);

function setUp() {
  const [entry] = topicTableSchema.parse([{ topic: '/cmd_vel', as: 'velocity' }]);
  if (entry === undefined) throw new Error('no entry');
  const graph = {
    kind: 'ros1' as const,
    masterUrl: 'http://127.0.0.1:9',
    name: 'sink',
    hostname: '127.0.0.1',
  };
  const sink = new RosSink({ graph, entry, silenceMs: 150 }, silentLogger(), THREAD);
  const readings: string[] = [];
  sink.tellReadings(({ level, values }) => readings.push(`${level} ${values[0]?.[1]}`));
  const guard = new DriveGuard({ limits: defaultDriveLimits, randomBytes: (count) => new Uint8Array(count) });
  const station = new DriveStation(
    new MotionSupervisor(guard),
    (twist) => sink.apply(twist, guard.estopState().latched),
    monotonicMs,
    () => sink.fault,
  );
  const wire = new BroadcastChannel('drive-worker');
  const published: { x: number; hold: boolean }[] = [];
  wire.onmessage = (event) => published.push((event as unknown as { data: (typeof published)[number] }).data);
  onTestFinished(async () => {
    wire.close();
    station.close();
    await sink.close();
  });
  guard.onOpenHand('op');
  const outcome = guard.requestLease('op', false, monotonicMs());
  const lease = outcome.granted ? outcome.lease : '';
  let sequence = 0;
  /** One command, as a page sends it. @returns what became of it */
  const drive = (x: number) => {
    const nowMs = monotonicMs();
    const twist = { ...zeroTwist(), linear: { x, y: 0, z: 0 } };
    const command: Command = {
      ...{ type: 'command', sequence: sequence++, timeMs: nowMs, lease, deadMan: x !== 0, twist },
    } as Command;
    const verdict = guard.onCommand('op', command, nowMs);
    station.apply();
    return verdict.accepted ? 'accepted' : verdict.reason;
  };
  /** Drives with a fresh hand until the thread has published it. */
  const driving = async () => {
    await eventually(() => sink.fault === null);
    published.length = 0;
    await eventually(
      () => drive(0) === 'accepted' && drive(0.3) === 'accepted' && published.at(-1)?.x === 0.3,
    );
  };
  return { sink, guard, wire, published, readings, drive, driving };
}

describe('the thread that publishes velocities', { timeout: 30_000 }, () => {
  it('refuses motion while it is gone; another is started, publishes zero first, and drives for a fresh hand', async () => {
    const { sink, guard, wire, published, readings, drive, driving } = setUp();
    expect(sink.fault).toBe('starting');
    expect(drive(0.3)).toBe('no-wheels');
    await driving();
    await eventually(() => readings.at(-1) === 'ok /cmd_vel: 1 listening');
    wire.postMessage('throw');
    await eventually(() => sink.fault === 'thread-ended');
    published.length = 0;
    expect(drive(0.3)).toBe('no-wheels');
    expect(guard.velocityAt(monotonicMs()).linear.x).toBe(0);
    expect(readings.at(-1)).toBe('error /cmd_vel: velocities cannot be published: trying again');
    await eventually(() => sink.fault === null);
    expect(sink.restarts).toBe(1);
    // The hand that held on moves nothing, and the wheels are told to stand.
    expect(drive(0.3)).toBe('let-go-first');
    await eventually(() => published.filter(({ hold }) => hold).length > 3);
    for (const { x } of published) expect(x).toBe(0);
    await driving();
  });

  it('refuses motion while it hangs, and is replaced', async () => {
    const { sink, wire, drive, driving } = setUp();
    await driving();
    wire.postMessage('hang');
    await eventually(() => sink.fault === 'thread-hung');
    expect(drive(0.3)).toBe('no-wheels');
    await eventually(() => sink.restarts === 1);
    await eventually(() => sink.fault === null);
    expect(drive(0.3)).toBe('let-go-first');
    await driving();
  });

  it('refuses motion while nobody subscribes', async () => {
    const { sink, wire, readings, drive, driving } = setUp();
    await driving();
    wire.postMessage('leave');
    await eventually(() => sink.fault === 'no-listener');
    expect(drive(0.3)).toBe('no-wheels');
    await eventually(() => readings.at(-1) === 'warn /cmd_vel: nobody listens to the velocities');
    wire.postMessage('join');
    await eventually(() => sink.fault === null);
    expect([drive(0.3), drive(0), drive(0.3)]).toEqual(['let-go-first', 'accepted', 'accepted']);
  });
});
