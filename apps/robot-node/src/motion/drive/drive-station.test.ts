import type { Twist } from '@farpoint/protocol';
import { defaultDriveLimits, MotionSupervisor } from '@farpoint/safety';
import { drivenGuard } from '@farpoint/safety/testing';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { DriveStation } from './drive-station.ts';

beforeEach(() => {
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout', 'setInterval', 'clearInterval', 'performance'] });
});
afterEach(() => {
  vi.useRealTimers();
});

function station() {
  const { guard, send } = drivenGuard();
  const applied: { atMs: number; twist: Twist }[] = [];
  const now = () => performance.now();
  const start = now();
  const drive = new DriveStation(
    new MotionSupervisor(guard),
    (twist) => applied.push({ atMs: now() - start, twist }),
    now,
  );
  const command = (x: number) => {
    send(now(), x);
    drive.apply();
  };
  const speeds = () => applied.map(({ twist }) => twist.linear.x);
  return { guard, drive, applied, command, speeds };
}

describe('DriveStation', () => {
  it('applies a change immediately', () => {
    const { guard, drive, command, speeds } = station();
    command(0.5);
    expect(speeds()).toEqual([0.5]);
    guard.latchEstop('operator');
    drive.apply();
    expect(speeds()).toEqual([0.5, 0]);
    drive.close();
  });

  it('stops the wheels at the watchdog’s deadline, not at the next beat', () => {
    const { drive, applied, command } = station();
    command(0.5);
    vi.advanceTimersByTime(400);
    const stopped = applied.find(({ twist }) => twist.linear.x === 0);
    expect(stopped?.atMs).toBe(defaultDriveLimits.watchdogMs);
    drive.close();
  });

  it('repeats the velocity well within the wheels’ own watchdog', () => {
    const { drive, applied, command } = station();
    command(0.5);
    vi.advanceTimersByTime(100);
    expect(applied.filter(({ twist }) => twist.linear.x === 0.5).length).toBeGreaterThanOrEqual(3);
    drive.close();
  });

  it('moves nothing once halted, whatever the guard lets through', () => {
    const { drive, command, speeds } = station();
    command(0.5);
    drive.halt();
    command(0.5);
    expect(speeds()).toEqual([0.5, 0, 0]);
    drive.close();
  });

  it('sends nothing once closed', () => {
    const { drive, applied, command } = station();
    command(0.5);
    drive.close();
    vi.advanceTimersByTime(1000);
    expect(applied).toHaveLength(1);
  });
});
