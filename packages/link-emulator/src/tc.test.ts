import { expect, test } from 'vitest';
import { burstLossOf } from './loss.ts';
import { idealProfile, type LinkProfile, ProfileError } from './profile.ts';
import { tcQdiscs, tcRate, tcRatePlace } from './tc.ts';

const words = (profile: Partial<LinkProfile>, mbps: number) =>
  tcQdiscs({ ...idealProfile, ...profile }, mbps).map((args) => args.join(' '));

test('no limits need no queueing discipline', () => {
  expect(words({}, Number.POSITIVE_INFINITY)).toEqual([]);
});

test('capacity alone is a token bucket with the queue behind it', () => {
  expect(words({ queue: { ms: 100 } }, 8)).toEqual([
    'root handle 10: tbf rate 8000000bit burst 3000 limit 100000',
  ]);
});

test('what happens to single packets comes before the capacity', () => {
  const profile = { delayMs: 30, jitterMs: 5, loss: 0.02, duplicate: 0.001, queue: { bytes: 50_000 } };
  expect(words(profile, 100)).toEqual([
    'root handle 1: netem limit 200000 delay 30ms 5ms loss random 2% duplicate 0.1%',
    'parent 1:1 handle 10: tbf rate 100000000bit burst 12500 limit 50000',
  ]);
  expect(tcRatePlace({ ...idealProfile, ...profile })).toEqual(['parent', '1:1']);
});

test('bursts are a Gilbert–Elliott model; both kinds of loss at once are refused', () => {
  const burstLoss = burstLossOf(0.04, 8);
  expect(words({ burstLoss }, Number.POSITIVE_INFINITY)).toEqual([
    'root handle 1: netem limit 200000 loss gemodel 0.520833% 12.5% 100% 0%',
  ]);
  expect(() => words({ burstLoss, loss: 0.1 }, 8)).toThrow(ProfileError);
});

test('an outage is the least rate there is', () => {
  expect(tcRate({ ...idealProfile, queue: { ms: 100 } }, 0).join(' ')).toBe(
    'tbf rate 1000bit burst 3000 limit 3000',
  );
});
