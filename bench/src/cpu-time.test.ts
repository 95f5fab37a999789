import { describe, expect, it } from 'vitest';
import { coresBetween, cpuSecondsOfTree, parseStat } from './cpu-time.ts';

describe('cpu time', () => {
  it('reads parent and times after a name that contains spaces and brackets', () => {
    const stat = '42 (a (b) c) S 7 42 42 0 -1 4194304 100 0 0 0 250 50 0 0 20 0 1 0 5 0 0';
    expect(parseStat(stat)).toEqual({ parent: 7, seconds: 3 });
  });

  it.runIf(process.platform === 'linux')('finds that this process has used some', () => {
    expect(cpuSecondsOfTree(process.pid)).toBeGreaterThan(0);
  });

  it('gives mean cores, or nothing without readings', () => {
    expect(coresBetween(1, 3, 4000)).toBe(0.5);
    expect(coresBetween(null, 3, 4000)).toBeNull();
  });
});
