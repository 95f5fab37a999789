import { type Command, type Twist, zeroTwist } from '@farpoint/protocol';
import { DriveGuard, defaultDriveLimits, MotionSupervisor } from '@farpoint/safety';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { DriveStation } from './drive-station.ts';

beforeEach(() => {
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout', 'setInterval', 'clearInterval', 'performance'] });
});
afterEach(() => {
  vi.useRealTimers();
});

function station() {
  const guard = new DriveGuard({ limits: defaultDriveLimits, randomBytes: (count) => new Uint8Array(count) });
  const applied: { atMs: number; twist: Twist }[] = [];
  const now = () => performance.now();
  const start = now();
  const drive = new DriveStation(
    new MotionSupervisor(guard),
    (twist) => applied.push({ atMs: now() - start, twist }),
    now,
  );
  guard.onOpenHand('op');
  const outcome = guard.requestLease('op', false, now());
  const lease = outcome.granted ? outcome.lease : '';
  const command = (sequence: number, x: number): Command => ({
    type: 'command',
    sequence,
    timeMs: now(),
    lease,
    deadMan: true,
    twist: { ...zeroTwist(), linear: { x, y: 0, z: 0 } },
  });
  const speeds = () => applied.map(({ twist }) => twist.linear.x);
  return { guard, drive, applied, command, now, speeds };
}

describe('DriveStation', () => {
  it('applies a change immediately', () => {
    const { guard, drive, command, now, speeds } = station();
    guard.onCommand('op', command(0, 0.5), now());
    drive.apply();
    expect(speeds()).toEqual([0.5]);
    guard.latchEstop('operator');
    drive.apply();
    expect(speeds()).toEqual([0.5, 0]);
    drive.close();
  });

  it('stops the wheels at the watchdog’s deadline, not at the next beat', () => {
    const { guard, drive, applied, command, now } = station();
    guard.onCommand('op', command(0, 0.5), now());
    drive.apply();
    vi.advanceTimersByTime(400);
    const stopped = applied.find(({ twist }) => twist.linear.x === 0);
    expect(stopped?.atMs).toBe(defaultDriveLimits.watchdogMs);
    drive.close();
  });

  it('repeats the velocity well within the wheels’ own watchdog', () => {
    const { guard, drive, applied, command, now } = station();
    guard.onCommand('op', command(0, 0.5), now());
    drive.apply();
    vi.advanceTimersByTime(100);
    expect(applied.filter(({ twist }) => twist.linear.x === 0.5).length).toBeGreaterThanOrEqual(3);
    drive.close();
  });

  it('moves nothing once halted, whatever the guard lets through', () => {
    const { guard, drive, command, now, speeds } = station();
    guard.onCommand('op', command(0, 0.5), now());
    drive.apply();
    drive.halt();
    guard.onCommand('op', command(1, 0.5), now());
    drive.apply();
    expect(speeds()).toEqual([0.5, 0, 0]);
    drive.close();
  });

  it('sends nothing once closed', () => {
    const { guard, drive, applied, command, now } = station();
    guard.onCommand('op', command(0, 0.5), now());
    drive.apply();
    drive.close();
    vi.advanceTimersByTime(1000);
    expect(applied).toHaveLength(1);
  });
});
