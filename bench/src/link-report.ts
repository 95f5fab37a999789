/** How `pnpm bench link` prints its figures. */
import type { LinkFigures } from './link-figures.ts';
import type { LinkOptions } from './link-options.ts';
import { distributionCells, printTable } from './report.ts';

export function printLink(options: LinkOptions, result: LinkFigures): void {
  const { canvas, drawEvery } = options;
  printLatencies(result);
  console.log(`drawn: ${drawEvery === 1 ? 'all points' : `1 of ${drawEvery} points`}, ${canvas} pixels`);
  console.log('');
  printStream(result);
  if (options.sensors > 1) printSensors(result);
  for (const { startS, endS, stoppedAfterMs, resumedAfterMs, words } of result.outages) {
    console.log(
      `no service ${startS}–${endS} s: stood after ${stoppedAfterMs ?? '–'} ms, points again after ${resumedAfterMs ?? '–'} ms; the page: ${words.join(' · ')}`,
    );
  }
  if (result.shareAgainstCrossFlow !== null)
    console.log(`share against ${options.cross}: ${(result.shareAgainstCrossFlow * 100).toFixed(0)} %`);
  if (result.shareAmongRobots !== null)
    console.log(
      `share of the first of ${options.robots} robots: ${(result.shareAmongRobots * 100).toFixed(0)} %`,
    );
}

function printLatencies({
  mtpMs,
  mtpFirstMs,
  mtpPartsMs: parts,
  queueMs,
  frameLatencyMs,
  renderMs,
}: LinkFigures): void {
  printTable(
    ['', 'p50', 'p95', 'p99', 'max'],
    [
      ['motion to whole cloud, ms', ...distributionCells(mtpMs)],
      ['  command to the robot', ...distributionCells(parts.command)],
      ['  wait for the camera', ...distributionCells(parts.captureWait)],
      ['  capture to last arrival', ...distributionCells(parts.delivery)],
      ['  arrival to photon', ...distributionCells(parts.display)],
      ['motion to first points, ms', ...distributionCells(mtpFirstMs)],
      ['queue of the link, ms', ...distributionCells(queueMs)],
      ...(frameLatencyMs === null ? [] : [['frame latency, ms', ...distributionCells(frameLatencyMs)]]),
      ...(renderMs === null ? [] : [['render, ms', ...distributionCells(renderMs)]]),
    ],
  );
}

function printStream(result: LinkFigures): void {
  const { total, simulator } = result.robotCpu;
  printTable(
    ['utilisation', 'points a frame', 'frames/s', 'loss', 'robot, cores', '… but simulator', 'recovery, s'],
    [
      [
        result.utilisation,
        result.pointsPerFrame,
        result.framesPerSecond,
        result.lossRate,
        total,
        total === null ? null : total - simulator,
        result.recoverySeconds,
      ],
    ],
  );
}

function printSensors({ sensors }: LinkFigures): void {
  printTable(
    ['sensor', 'points a frame', 'frames/s', 'frame latency, ms: p50', 'p95', 'p99', 'max', 'share'],
    sensors.map((row) => [
      row.name,
      row.pointsPerFrame,
      row.framesPerSecond,
      ...distributionCells(row.frameLatencyMs),
      row.share,
    ]),
  );
}

export function plotTitles(options: LinkOptions, { link, mtpMs, utilisation }: LinkFigures) {
  return {
    title: `Farpoint over ${link}, RTT ${options.rttMs} ms`,
    subtitle: `${options.mode === 'auto' ? 'the whole cloud' : 'points64'}, ${options.plan} plan, ${options.rateControl} rate; motion to photon p50 ${mtpMs.p50} ms, p95 ${mtpMs.p95} ms; utilisation ${(utilisation * 100).toFixed(0)} %`,
  };
}
