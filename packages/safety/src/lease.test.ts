import { handleSchema } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { type LeaseOptions, LeaseTable } from './lease.ts';
import { countingBytes } from './testing/driven-guard.ts';

function table(options: Partial<LeaseOptions> = {}): LeaseTable {
  return new LeaseTable({ randomBytes: countingBytes(), takeAfterIdleMs: 5000, ...options });
}

test('the first operator that asks may drive, under a lease of 128 random bits', () => {
  const leases = table();
  const outcome = leases.request('a', false, 0);
  expect(outcome).toEqual({ granted: true, lease: '01'.repeat(16), takenFrom: null });
  expect(handleSchema.safeParse('01'.repeat(16)).success).toBe(true);
  expect(leases.holder).toBe('a');
  expect(leases.holds('a', '01'.repeat(16))).toBe(true);
});

test('nobody drives with another’s lease, and the holder not with a different lease', () => {
  const leases = table();
  leases.request('a', false, 0);
  expect(leases.holds('b', '01'.repeat(16))).toBe(false);
  expect(leases.holds('a', '02'.repeat(16))).toBe(false);
  expect(leases.leaseOf('b')).toBeNull();
});

test('asking again gives the holder the same lease', () => {
  const leases = table();
  const first = leases.request('a', false, 0);
  expect(leases.request('a', true, 9000)).toEqual(first);
});

test('a request without take-over is refused, however idle the holder is', () => {
  const leases = table({ takePolicy: 'always' });
  leases.request('a', false, 0);
  expect(leases.request('b', false, 1e9)).toMatchObject({ granted: false, reason: 'held' });
});

test('idle: take-over only after nothing has moved for the given time', () => {
  const leases = table();
  leases.request('a', false, 0);
  leases.noteMotion(1000);
  expect(leases.request('b', true, 5999)).toMatchObject({ granted: false, reason: 'take-refused' });
  expect(leases.request('b', true, 6000)).toMatchObject({ granted: true, takenFrom: 'a' });
  expect(leases.holds('a', '01'.repeat(16))).toBe(false);
  expect(leases.holds('b', '02'.repeat(16))).toBe(true);
});

test('a new holder has the full time before it counts as idle', () => {
  const leases = table();
  leases.request('a', false, 10_000);
  expect(leases.request('b', true, 14_999).granted).toBe(false);
});

test('never and always', () => {
  const never = table({ takePolicy: 'never' });
  never.request('a', false, 0);
  expect(never.request('b', true, 1e9)).toMatchObject({ granted: false, reason: 'take-refused' });
  const always = table({ takePolicy: 'always' });
  always.request('a', false, 0);
  expect(always.request('b', true, 0)).toMatchObject({ granted: true, takenFrom: 'a' });
});

test('only the holder hands it over, to another operator, who gets a lease of its own', () => {
  const leases = table({ takePolicy: 'never' });
  expect(leases.handOver('a', 'b', 0)).toBe(false);
  leases.request('a', false, 0);
  expect(leases.handOver('b', 'b', 0)).toBe(false);
  expect(leases.handOver('b', 'a', 0)).toBe(false);
  expect(leases.handOver('a', 'a', 0)).toBe(false);
  expect(leases.leaseOf('a')).toBe('01'.repeat(16));
  expect(leases.handOver('a', 'b', 0)).toBe(true);
  expect(leases.leaseOf('a')).toBeNull();
  expect(leases.leaseOf('b')).toBe('02'.repeat(16));
});
