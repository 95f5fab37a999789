import { expect, it } from 'vitest';
import {
  DRIVER_LIMITS,
  type Intake,
  PeerBudget,
  SHARED_LIMITS,
  SharedBudget,
  WATCHER_LIMITS,
} from './peer-budget.ts';

const KINDS: Intake[] = ['sctp', 'rtcp', 'stun', 'stun-again'];

function taken(budget: PeerBudget, intake: Intake, nowMs: number): number {
  let count = 0;
  while (budget.take(intake, 1, nowMs)) count++;
  return count;
}

it('gives each kind its own share, and fills it again', () => {
  const budget = new PeerBudget();
  for (const kind of KINDS) expect(taken(budget, kind, 0)).toBe(WATCHER_LIMITS[kind].burst);
  for (const kind of KINDS) expect(taken(budget, kind, 1000)).toBe(WATCHER_LIMITS[kind].perSecond);
});

it('takes what costs more as more, and not in part', () => {
  const budget = new PeerBudget();
  expect(budget.take('sctp', WATCHER_LIMITS.sctp.burst! - 5, 0)).toBe(true);
  expect(budget.take('sctp', 6, 0)).toBe(false);
  expect(budget.take('sctp', 5, 0)).toBe(true);
});

it('gives more to the one who drives, at once, whatever it used up before', () => {
  let drives = false;
  const budget = new PeerBudget(() => drives);
  taken(budget, 'sctp', 0);
  drives = true;
  expect(taken(budget, 'sctp', 0)).toBe(DRIVER_LIMITS.sctp.burst);
  drives = false;
  expect(taken(budget, 'sctp', 0)).toBe(0);
});

it('gives many watchers no more than their common share, and leaves the driver its own', () => {
  const shared = new SharedBudget();
  const watchers = Array.from({ length: 30 }, () => new PeerBudget(() => false, shared));
  for (const kind of KINDS) {
    const sum = watchers.reduce((all, watcher) => all + taken(watcher, kind, 0), 0);
    expect(sum).toBe(SHARED_LIMITS[kind].burst);
    expect(taken(new PeerBudget(() => true, shared), kind, 0)).toBe(DRIVER_LIMITS[kind].burst);
  }
});

it('lets one watcher alone not use up what is shared', () => {
  const shared = new SharedBudget();
  for (const kind of KINDS) {
    taken(new PeerBudget(() => false, shared), kind, 0);
    expect(taken(new PeerBudget(() => false, shared), kind, 0)).toBe(WATCHER_LIMITS[kind].burst);
  }
});
