import { rmSync } from 'node:fs';
import { zeroTwist } from '@farpoint/protocol';
import { defaultDriveLimits, MotionSupervisor } from '@farpoint/safety';
import { drivenGuard } from '@farpoint/safety/testing';
import type { Logger } from '@farpoint/service';
import { testFolder } from '@farpoint/service/testing/folder';
import { isAvailable, ReferenceControlReader } from '@farpoint/shared-memory';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { DriveStation } from './drive-station.ts';
import { openSink } from './open-sink.ts';

let folder: string;
beforeEach(() => {
  folder = testFolder();
});
const open: { close(): void }[] = [];
afterEach(() => {
  for (const each of open.splice(0)) void each.close();
});

const errors: unknown[] = [];
const log = { error: (detail: unknown) => errors.push(detail) } as unknown as Logger;

function setUp(silenceMs = 60_000) {
  const sink = openSink({ kind: 'shm', folder, mode: 0o600, silenceMs }, null, log);
  let nowMs = 1000;
  const { guard, send } = drivenGuard();
  const station = new DriveStation(
    new MotionSupervisor(guard),
    (twist) => sink.apply(twist, false),
    () => nowMs,
  );
  const reader = new ReferenceControlReader(folder);
  open.push(station, sink, reader);
  const drive = (x: number) => {
    send(nowMs, x);
    station.apply();
  };
  const pass = (ms: number) => {
    nowMs += ms;
    station.apply();
  };
  return { sink, guard, station, reader, drive, pass };
}

describe.skipIf(!isAvailable())('velocity into shared memory (needs the addon: pnpm build:native)', () => {
  it('gets what the guard lets through: a command within the limits, zero on silence, and a counter that advances', () => {
    const { reader, drive, pass } = setUp();
    drive(0.3);
    const first = reader.read();
    expect(first?.twist).toEqual({ ...zeroTwist(), linear: { x: 0.3, y: 0, z: 0 } });
    pass(40);
    drive(100);
    const second = reader.read();
    expect(second?.twist.linear.x).toBe(0.3);
    expect(second?.counter).toBeGreaterThan(first?.counter as number);
    pass(defaultDriveLimits.watchdogMs);
    expect(reader.read()?.twist).toEqual(zeroTwist());
    expect(reader.read()?.counter).toBeGreaterThan(second?.counter as number);
  });

  it('becomes zero when the emergency stop latches, and on closing', () => {
    const { sink, guard, station, reader, drive } = setUp();
    drive(0.3);
    guard.latchEstop('operator');
    station.apply();
    expect(reader.read()?.twist).toEqual(zeroTwist());
    sink.apply({ ...zeroTwist(), linear: { x: 0.1, y: 0, z: 0 } }, false);
    sink.close();
    expect(reader.read()?.twist).toEqual(zeroTwist());
  });

  it('becomes zero if this thread hangs after writing a velocity', () => {
    const { reader, drive } = setUp(5);
    drive(0.3);
    const deadline = performance.now() + 10_000;
    while (reader.read()?.twist.linear.x !== 0 && performance.now() < deadline);
    expect(reader.read()?.twist).toEqual(zeroTwist());
  });

  it('reports once that the block cannot be written, and continues when it can be', () => {
    const { drive, pass } = setUp();
    rmSync(folder, { recursive: true });
    drive(0.3);
    pass(40);
    expect(errors).toHaveLength(1);
    expect(errors[0]).toMatchObject({ err: { code: 'absent' } });
  });
});

describe('velocity to a base', () => {
  it('is passed to the base if there is one, otherwise to nothing', () => {
    const got: unknown[] = [];
    const base = { kind: 'test', apply: (twist: unknown) => void got.push(twist), close: () => undefined };
    const twist = { ...zeroTwist(), linear: { x: 0.1, y: 0, z: 0 } };
    openSink({ kind: 'base' }, base, log).apply(twist, false);
    expect(got).toEqual([twist]);
    openSink({ kind: 'base' }, null, log).apply(twist, false);
    expect(got).toHaveLength(1);
  });
});
