/** `pnpm bench prediction`: how far the view is from the robot, with and without prediction, in simulated time. */

import { benchOptions, option } from './bench-options.ts';
import type { BaseKind } from './prediction-bases.ts';
import { ROUND_S } from './prediction-drive.ts';
import { type DriveResult, type DriveSpec, driveOnce } from './prediction-run.ts';
import { type Bench, printJson, printTable } from './report.ts';

const USAGE = `pnpm bench prediction [--rounds 4] [--seed 1] [--json]

Kernel benchmark, in simulated time: a hand drives a base at up to 1 m/s over a link, with turns, stops and a stick. Compares
the shown pose with the base's true pose when the picture is shown: predicted, and as the page follows the newest pose
without prediction. At first, only what the robot says of itself is known of the base; the first round is reported apart, and
so is a session that begins with a turn at 1.5 rad/s.`;

/** The link that has targets. */
const TARGET_LOOP_MS = 150;
const TARGETS = { errorM: 0.05, errorDeg: 2, ratio: 3, correctionM: 0.03, inputToViewMs: 1000 / 60 + 10 };

function specs(rounds: number, seed: number): Record<string, DriveSpec> {
  const of = (loopMs: number, base: BaseKind, other: Partial<DriveSpec> = {}): DriveSpec => ({
    base,
    loopMs,
    upShare: 0.5,
    jitterMs: 0,
    loss: 0,
    noiseM: 0,
    rounds,
    seed,
    ...other,
  });
  return {
    '60 ms': of(60, 'sim'),
    '150 ms': of(TARGET_LOOP_MS, 'sim'),
    '150 ms, jitter ± 15 ms, 2 % loss': of(TARGET_LOOP_MS, 'sim', { jitterMs: 15, loss: 0.02 }),
    '150 ms, 100 there and 50 back': of(TARGET_LOOP_MS, 'sim', { upShare: 2 / 3 }),
    '150 ms, poses ± 5 mm, ± 0.3°': of(TARGET_LOOP_MS, 'sim', { noiseM: 0.005 }),
    '300 ms': of(300, 'sim'),
    '300 ms, jitter ± 30 ms, 5 % loss': of(300, 'sim', { jitterMs: 30, loss: 0.05 }),
    '150 ms, sluggish base': of(TARGET_LOOP_MS, 'sluggish'),
    '300 ms, sluggish base': of(300, 'sluggish'),
  };
}

/** Whether a run on the link that has targets meets them. */
export function meetsTargets({
  predicted,
  firstTurn,
  ratioM,
  ratioDeg,
  correctionM,
  inputToViewMs,
}: DriveResult): boolean {
  return (
    predicted.errorM.p95 <= TARGETS.errorM &&
    predicted.errorDeg.p95 <= TARGETS.errorDeg &&
    firstTurn.errorDeg.p95 <= TARGETS.errorDeg &&
    Math.min(ratioM, ratioDeg) >= TARGETS.ratio &&
    correctionM <= TARGETS.correctionM &&
    inputToViewMs.max <= TARGETS.inputToViewMs
  );
}

export const bench: Bench = {
  name: 'prediction',
  summary: 'kernel: error of the predicted view against the robot’s true pose, in simulated time',
  usage: USAGE,
  async run(argv) {
    const options = benchOptions(argv, { rounds: option.number(4, { least: 2 }), seed: option.number(1) });
    const rounds = Math.round(options.rounds);
    const seed = Math.round(options.seed);
    const results = Object.entries(specs(rounds, seed)).map(([link, spec]) => ({ link, ...driveOnce(spec) }));
    print(results);
    const target = results.find(({ spec }) => spec.loopMs === TARGET_LOOP_MS) as LinkResult;
    console.log(
      `rounds of ${Math.round(ROUND_S)} s; 150 ms ${meetsTargets(target) ? 'meets' : 'MISSES'} its targets`,
    );
    if (options.json) printJson({ ...figuresOf(target), rows: results });
  },
};

interface LinkResult extends DriveResult {
  link: string;
}

function print(results: readonly LinkResult[]): void {
  printTable(
    [
      'loop',
      'error p50, cm',
      'p95',
      'yaw p50, °',
      'p95',
      'first round p95, cm',
      '°',
      'first turn p95, °',
      'without p95, cm',
      '°',
      '× less, m',
      '°',
      'correction, cm',
      '°',
      'input to view, ms',
    ],
    results.map((result) => {
      const { link, predicted, cold, firstTurn, without, ratioM, ratioDeg } = result;
      const { correctionM, correctionDeg } = result;
      return [
        link,
        predicted.errorM.p50 * 100,
        predicted.errorM.p95 * 100,
        predicted.errorDeg.p50,
        predicted.errorDeg.p95,
        cold.errorM.p95 * 100,
        cold.errorDeg.p95,
        firstTurn.errorDeg.p95,
        without.errorM.p95 * 100,
        without.errorDeg.p95,
        ratioM,
        ratioDeg,
        correctionM * 100,
        correctionDeg,
        result.inputToViewMs.max,
      ];
    }),
  );
}

/** Figures that `--json` prints of the run on the link that has targets. */
function figuresOf(target: LinkResult) {
  const { predicted, firstTurn, without } = target;
  return {
    bench: 'prediction',
    loopMs: TARGET_LOOP_MS,
    errorM: predicted.errorM,
    errorDeg: predicted.errorDeg,
    firstTurnDeg: firstTurn.errorDeg,
    withoutM: without.errorM,
    withoutDeg: without.errorDeg,
    ratioM: target.ratioM,
    ratioDeg: target.ratioDeg,
    correctionM: target.correctionM,
    correctionDeg: target.correctionDeg,
    inputToViewMs: target.inputToViewMs,
    ok: meetsTargets(target),
  };
}
