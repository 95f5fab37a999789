import { type Command, zeroTwist } from '@farpoint/protocol';
import type { CommandVerdict } from '../command-gate.ts';
import { DriveGuard, type DriveGuardOptions } from '../drive-guard.ts';
import { defaultDriveLimits } from '../limits.ts';

/** Bytes 1,1,1… for the first lease, 2,2,2… for the second. */
export function countingBytes(): (count: number) => Uint8Array {
  let next = 0;
  return (count) => new Uint8Array(count).fill(++next);
}

/** With the default limits. */
export function makeGuard(options: Partial<DriveGuardOptions> = {}): DriveGuard {
  return new DriveGuard({ limits: defaultDriveLimits, randomBytes: countingBytes(), ...options });
}

/** Of a hand that holds the grip, and asks for these velocities. */
export function commandOf(x: number, z: number, change: Partial<Command> = {}): Command {
  return {
    ...{ type: 'command', sequence: 1, timeMs: 0, lease: 'lease', deadMan: true },
    twist: { ...zeroTwist(), linear: { x, y: 0, z: 0 }, angular: { x: 0, y: 0, z } },
    ...change,
  };
}

/** A guard whose lease operator `a` holds, with an open hand, and what sends a's commands, each with the next number. */
export function drivenGuard(options: Partial<DriveGuardOptions> = {}) {
  const guard = makeGuard(options);
  guard.onOpenHand('a');
  const outcome = guard.requestLease('a', false, 0);
  if (!outcome.granted) throw new Error('no lease');
  const { lease } = outcome;
  let sequence = 0;
  const send = (nowMs: number, x: number, change: Partial<Command> = {}, z = 0): CommandVerdict =>
    guard.onCommand('a', commandOf(x, z, { sequence: sequence++, timeMs: nowMs, lease, ...change }), nowMs);
  return { guard, send, lease };
}
