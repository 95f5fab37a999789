/**
 * The suites against stand-ins for the released programs: they pass at level `reference` and fail at level `strict`.
 * Signaling: ../main.stack.test.ts.
 */
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import type { KnownDefect } from '../known-defects.ts';
import { ReleasedBridge, ReleasedRobot, ReleasedSignaling } from '../testing/index.ts';
import { bridgeSuite } from './bridge-suite.ts';
import { robotSuite } from './robot-suite.ts';
import { type CaseResult, type ConformanceCase, type Level, runSuite } from './suite.ts';

let signaling: ReleasedSignaling;
beforeEach(async () => {
  signaling = await ReleasedSignaling.start();
  onTestFinished(() => signaling.stop());
});

const failed = (results: readonly CaseResult[]) => results.filter(({ outcome }) => outcome === 'failed');

/** Every defect of the suite shows at level `reference`, and no other case fails. */
async function expectAllDefects<Target>(
  suite: readonly ConformanceCase<Target>[],
  target: Target,
): Promise<void> {
  const results = await runSuite(suite, target, 'reference');
  expect(failed(results)).toEqual([]);
  const shown = results.flatMap(({ defect }) => (defect === null ? [] : [defect]));
  const known = suite.flatMap(({ defect }): KnownDefect[] => (defect === undefined ? [] : [defect]));
  expect(shown).toEqual(known);
}

describe('robot', { timeout: 60_000 }, () => {
  it.each(['as robot 0, which registers again on its socket', 'as another, which offers again'])(
    'passes at level reference %s',
    async (which) => {
      if (which.startsWith('as another')) {
        const first = await ReleasedRobot.start(signaling.robotUrl, { name: 'first' });
        onTestFinished(() => first.stop());
      }
      const robot = await ReleasedRobot.start(signaling.robotUrl, { offerAgainMs: 100 });
      onTestFinished(() => robot.stop());
      await expectAllDefects(robotSuite, { client: signaling.clientUrl, name: 'robot' });
      expect(robot.offers).toBeGreaterThanOrEqual(robotSuite.length);
    },
  );
});

describe('bridge', { timeout: 120_000 }, () => {
  const run = async (level: Level) => {
    const bridge = await ReleasedBridge.start();
    onTestFinished(() => bridge.stop());
    const target = { robot: signaling.robotUrl, client: signaling.clientUrl, ...bridge.sockets };
    if (level === 'reference') await expectAllDefects(bridgeSuite, target);
    return { bridge, target };
  };

  it('passes at level reference with its defects named, and keeps running', async () => {
    const { bridge } = await run('reference');
    expect(bridge.death).toBeNull();
  });

  it('ends at level strict', async () => {
    const { bridge, target } = await run('strict');
    const deadly = bridgeSuite.filter((tried) => tried.deadly);
    expect(failed(await runSuite(deadly, target, 'strict')).length).toBe(deadly.length);
    expect(bridge.death).not.toBeNull();
  });
});
