import type { EstopReleasePolicy } from '@farpoint/protocol';
import { makeGuard } from '@farpoint/safety/testing';
import { testFolder } from '@farpoint/service/testing/folder';
import { beforeEach, describe, expect, it } from 'vitest';
import { EstopJournal } from './estop-journal.ts';
import { LocalRelease } from './local-release.ts';
import { ReleaseRequest } from './release-request.ts';

let folder: string;
beforeEach(() => {
  folder = testFolder();
});

const STEP_MS = 25;

function setUp(estopRelease: EstopReleasePolicy = 'driver') {
  const guard = makeGuard({ estopRelease });
  const request = new ReleaseRequest(folder, 'robot-1');
  const lines: string[] = [];
  const log = { warn: (...said: unknown[]) => lines.push(String(said.at(-1))) };
  let nowMs = 0;
  guard.latchEstop('robot');
  const release = new LocalRelease(request, guard, log as never);
  return {
    ...{ guard, request, lines },
    /** @returns whether it was released in this time */
    run: (ms: number) => {
      let released = false;
      for (const end = nowMs + ms; nowMs < end; nowMs += STEP_MS) released = release.look(nowMs) || released;
      return released;
    },
    now: () => nowMs,
  };
}

describe('LocalRelease', () => {
  it('releases once for each request, and never without one', () => {
    const { guard, request, run } = setUp();
    expect(run(2000)).toBe(false);
    request.make();
    expect(run(250)).toBe(true);
    expect(guard.estopState().latched).toBe(false);
    guard.latchEstop('robot');
    expect(run(2000)).toBe(false);
  });

  it('does not undo a STOP that was pressed after the request', () => {
    const { guard, request, run, lines } = setUp();
    run(250);
    request.make();
    guard.latchEstop('operator', 'ada');
    expect(run(1000)).toBe(false);
    expect(lines).toEqual([expect.stringContaining('latched again in the meantime')]);
    request.make();
    expect(run(250)).toBe(true);
  });

  it('does not release what a stop at the robot holds', () => {
    const { guard, request, run, lines } = setUp();
    guard.holdEstop('gpio');
    run(250);
    request.make();
    expect(run(1000)).toBe(false);
    expect(lines).toEqual([expect.stringContaining('released there')]);
  });

  it.each<[EstopReleasePolicy, boolean]>([
    ['driver', true],
    ['latcher', false],
    ['supervisor', false],
  ])('releases what an operator who is there has latched, by the policy %s: %s', (policy, expected) => {
    const { guard, request, run } = setUp(policy);
    guard.latchEstop('operator', 'ada');
    run(250);
    request.make();
    expect(run(250)).toBe(expected);
    expect(guard.estopState().latched).toBe(!expected);
  });
});

it('a robot that starts forgets a request from before', () => {
  const request = new ReleaseRequest(folder, 'robot-1');
  request.make();
  const journal = new EstopJournal(folder, 'robot-1', () => undefined);
  expect(journal.request.take()).toBe(false);
});
