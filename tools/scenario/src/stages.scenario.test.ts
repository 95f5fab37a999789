/** Where the time goes: the page names the stage that is slow, whichever it is, and says how slow. */
import type { CommandStage, FrameStage, StageSummary } from '@farpoint/operator';
import { describe, expect, test } from 'vitest';
import type { ScenarioOperator } from './operator.ts';
import { Scenario } from './scenario.ts';

const [LINK_MS, MBPS] = [42, 20];
/** A display frame takes 16 ms: a cloud waits for half of one, and its last millisecond. */
const DRAW_MS = 16;
/** Within this time the clocks are compared by probes from before a queue arose (packages/protocol, ClockOffset). */
const PROBED_MS = 4000;

interface Connected {
  scenario: Scenario;
  operator: ScenarioOperator;
}

function connected(): Connected {
  const scenario = new Scenario({ link: { delayMs: LINK_MS } });
  const operator = scenario.connected();
  scenario.run(2000);
  return { scenario, operator };
}

function frames({ scenario, operator }: Connected, overMs: number): StageSummary<FrameStage> {
  const { window } = operator.client.statistics.frameStages() as NonNullable<
    ReturnType<ScenarioOperator['client']['statistics']['frameStages']>
  >;
  const summary = window.summary(scenario.nowMs, overMs);
  for (const { told, totalMs, stages } of window.rows(scenario.nowMs)) {
    if (!told || totalMs === null) continue;
    const sum = Object.values(stages).reduce<number>((all, ms) => all + (ms as number), 0);
    // To the microsecond of a stamp.
    expect(Math.abs(sum - totalMs)).toBeLessThan(0.002);
  }
  return summary;
}

function within(ms: number | undefined, expected: number, toleranceMs = expected * 0.1): void {
  expect(Math.abs((ms ?? Number.NaN) - expected), `${ms} ms, not ${expected}`).toBeLessThanOrEqual(
    toleranceMs,
  );
}

describe('of clouds', () => {
  test('a link of 42 ms, and nothing else', () => {
    const run = connected();
    using _ = run.scenario;
    const { operator } = run;
    const { worst, stages, totalMs, untold, rows } = frames(run, 1000);
    expect([worst, untold]).toEqual(['link', 0]);
    expect(rows).toBeGreaterThanOrEqual(30);
    within(stages.link?.p50, LINK_MS);
    for (const stage of ['capture', 'encode', 'queue', 'decode'] as const) within(stages[stage]?.p95, 0, 1);
    within(totalMs?.p50, LINK_MS + DRAW_MS / 2, DRAW_MS / 2);
    within(totalMs?.p50, operator.client.stats().frameLatencyMs?.p50 ?? 0, 2);
  });

  test('a queue of 100 ms in the link', () => {
    const run = connected();
    const { operator } = run;
    using scenario = run.scenario;
    const mostMs = 100;
    const packet = (bytes: number) => operator.up.send(bytes, () => undefined);
    for (let i = 0; i < mostMs; i++) packet((MBPS * 1000) / 8);
    // Others fill it as fast as it empties: what the robot sends takes a fiftieth.
    const others = setInterval(() => packet(((MBPS * 1000) / 8) * 0.98), 1);
    scenario.run(PROBED_MS);
    clearInterval(others);
    const { worst, stages, totalMs } = frames(run, 3000);
    expect(worst).toBe('link');
    within(stages.link?.p50, LINK_MS + mostMs);
    within(totalMs?.p50, LINK_MS + mostMs + DRAW_MS / 2, DRAW_MS);
  });

  test.each([
    ['capture', { captureMs: 90 }, 90],
    ['encode', { encodeMs: 80 }, 80],
    ['queue', { queueMs: 100 }, 100],
  ] as const)('a slow robot: %s', (stage, slow, ms) => {
    const run = connected();
    using scenario = run.scenario;
    Object.assign(scenario.robot.slow, slow);
    scenario.run(3000);
    const { worst, stages, totalMs } = frames(run, 2000);
    expect(worst).toBe(stage);
    within(stages[stage]?.p50, ms);
    within(stages.link?.p50, LINK_MS);
    within(totalMs?.p50, LINK_MS + ms + DRAW_MS / 2, DRAW_MS / 2);
  });

  test('a slow page', () => {
    const run = connected();
    const { operator } = run;
    using scenario = run.scenario;
    operator.pageMs = 100;
    scenario.run(3000);
    const { worst, stages } = frames(run, 2000);
    expect(worst).toBe('decode');
    within(stages.decode?.p50, 100);
    within(stages.link?.p50, LINK_MS);
  });

  test('a page that draws five times a second', () => {
    const run = connected();
    const { operator } = run;
    using scenario = run.scenario;
    operator.draws = false;
    const draws = setInterval(() => operator.client.noteDrawn(scenario.nowMs), 200);
    scenario.run(3000);
    clearInterval(draws);
    const { worst, stages } = frames(run, 2000);
    expect(worst).toBe('draw');
    within(stages.draw?.p50, 100, 20);
  });
});

describe('of commands', () => {
  const of = (scenario: Scenario, { client }: ScenarioOperator): StageSummary<CommandStage> =>
    client.statistics.commands.window.summary(scenario.nowMs, 1000);

  test('a link of 42 ms, and nothing else', () => {
    using scenario = new Scenario({ link: { delayMs: LINK_MS } });
    const { worst, stages, totalMs, untold } = of(scenario, scenario.driving());
    expect([worst, untold]).toEqual(['link', 0]);
    within(stages.link?.p50, LINK_MS);
    within(totalMs?.p50, LINK_MS);
    for (const stage of ['hand', 'page', 'gate', 'wheels'] as const) within(stages[stage]?.p95, 0, 1);
  });

  test('a hand that was read 90 ms before', () => {
    using scenario = new Scenario({ link: { delayMs: LINK_MS } });
    const operator = scenario.driving();
    Object.defineProperty(operator.hand, 'readMs', { get: () => scenario.nowMs - 90 });
    scenario.run(1500);
    const { worst, stages, totalMs } = of(scenario, operator);
    expect(worst).toBe('hand');
    within(stages.hand?.p50, 90);
    within(totalMs?.p50, 90 + LINK_MS);
  });

  test('those that are refused have no total', () => {
    using scenario = new Scenario({ link: { delayMs: LINK_MS } });
    const operator = scenario.driving();
    operator.client.estop();
    scenario.run(2500);
    const { stages, totalMs, rows } = of(scenario, operator);
    expect(rows).toBeGreaterThan(30);
    expect([stages.wheels, totalMs]).toEqual([null, null]);
    within(stages.link?.p50, LINK_MS);
    expect(operator.client.statistics.commands.refused).toBeGreaterThan(30);
  });
});
