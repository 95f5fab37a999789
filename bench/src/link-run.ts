/** Drives one robot through the emulated link and records what happens. */
import { readFileSync } from 'node:fs';
import type { Page } from '@playwright/test';
import type { LinkBin, PageSample, RobotSample } from './link-analysis.ts';
import { monotonicMs } from './measured-span.ts';

export interface LatencySample {
  /** When the operator acted, on the robot's clock, ms. */
  timeMs: number;
  /** `null`: no answer arrived. */
  mtpMs: number | null;
  firstMs: number | null;
  /** The parts of the latency, ms; `null` if the robot's part is unknown. */
  parts: LatencyParts | null;
}

/** The parts of motion-to-photon, ms. */
export interface LatencyParts {
  /** From the input event to the robot. */
  command: number;
  /** Until the camera's next image. */
  captureWait: number;
  /** Capture, sampling, packing, sending and the link, until the last packet's arrival. */
  delivery: number;
  /** Until the end of the display frame. */
  display: number;
}

export interface PageRun {
  series: PageSample[];
  latencies: LatencySample[];
}

/** What to add to the page's `performance.now()` to get {@link monotonicMs}. Both clocks are on this machine. */
export async function clockOffsetOf(page: Page): Promise<number> {
  let best = { tookMs: Number.POSITIVE_INFINITY, offset: 0 };
  for (let i = 0; i < 10; i++) {
    const before = monotonicMs();
    const now = await page.evaluate(() => performance.now());
    const after = monotonicMs();
    if (after - before < best.tookMs) best = { tookMs: after - before, offset: (before + after) / 2 - now };
  }
  return best.offset;
}

/**
 * Drives in circles for `seconds` and repeats latency tests, at times unrelated to the camera's. Leaves it to the
 * page to restore a lost session.
 */
export async function drivePage(page: Page, seconds: number): Promise<PageRun> {
  const offset = await clockOffsetOf(page);
  const { series, latencies } = await page.evaluate(driveAndTest, seconds * 1000);
  const shift = <T extends { timeMs: number }>(samples: readonly T[]) =>
    samples.map((sample) => ({ ...sample, timeMs: sample.timeMs + offset }));
  return { series: shift(series), latencies: shift(latencies).map(latencySampleOf) };
}

/** Runs in the page, where nothing outside its braces exists. */
async function driveAndTest(ms: number): Promise<{ series: PageSample[]; latencies: PageLatency[] }> {
  const { farpoint } = window;
  const pause = (time: number) => new Promise((resolve) => setTimeout(resolve, time));
  const end = performance.now() + ms;
  const series: PageSample[] = [];
  const latencies: PageLatency[] = [];
  const timer = setInterval(() => {
    const { packetsReceived, packetsLost, framesDrawn, pointsDrawn } = farpoint.stats();
    const { session, link, holder } = farpoint.state();
    series.push({
      timeMs: performance.now(),
      packetsReceived,
      packetsLost,
      framesDrawn,
      pointsDrawn,
      session,
      link,
    });
    if (session === 'live' && holder === 'nobody') farpoint.requestLease();
  }, 100);
  const driving = (async () => {
    // Let go from time to time: after an interruption, the robot wants the grip to be released once.
    while (performance.now() < end) {
      await farpoint.drive({ forward: 0.4, left: 0.5 }, 900);
      await pause(100);
    }
  })();
  for (let i = 0; performance.now() < end; i++) {
    // The golden ratio's sequence is spread evenly over the camera's period.
    await pause(60 + ((i * 0.618034) % 1) * 80);
    const timeMs = performance.now();
    const result = await farpoint.latencyTest().catch(() => null);
    if (result === null) await pause(100);
    latencies.push({
      timeMs,
      mtpMs: result?.mtpMs ?? null,
      firstMs: result?.firstMs ?? null,
      arrivedMs: result?.arrivedMs ?? 0,
      robot: result?.robot ?? null,
    });
  }
  await driving;
  clearInterval(timer);
  return { series, latencies };
}

/** @param latency with `timeMs` on the robot's clock */
function latencySampleOf({ timeMs, mtpMs, firstMs, arrivedMs, robot }: PageLatency): LatencySample {
  const parts =
    mtpMs === null || robot === null
      ? null
      : {
          command: robot.commandMs - timeMs,
          captureWait: robot.captureMs - robot.commandMs,
          delivery: timeMs + arrivedMs - robot.captureMs,
          display: mtpMs - arrivedMs,
        };
  return { timeMs, mtpMs, firstMs, parts };
}

interface PageLatency {
  timeMs: number;
  mtpMs: number | null;
  firstMs: number | null;
  arrivedMs: number;
  robot: { commandMs: number; captureMs: number } | null;
}

/** Reads lines of JSON; ignores a truncated last line. */
function readLines<T>(path: string): T[] {
  const text = readFileSync(path, 'utf8');
  return text
    .slice(0, text.lastIndexOf('\n') + 1)
    .split('\n')
    .filter((line) => line !== '')
    .map((line) => JSON.parse(line) as T);
}

export function readRobotSamples(path: string): RobotSample[] {
  return readLines<RobotSample>(path);
}

/** The direction from the robot to the operator, in one run of the link. */
export function readUplink(path: string): LinkBin[] {
  return readLines<LinkBin & { type: string; direction: string }>(path).filter(
    ({ type, direction }) => type === 'bin' && direction === 'up',
  );
}

/** Values of a Prometheus counter by its label. */
export async function scrape(url: string, name: string, label: string): Promise<Record<string, number>> {
  const text = await (await fetch(`${url}/metrics`)).text();
  const sums: Record<string, number> = {};
  const line = new RegExp(`^${name}\\{[^}]*${label}="([^"]*)"[^}]*\\} (\\S+)$`, 'gm');
  for (const [, value, number] of text.matchAll(line)) sums[value as string] = Number(number);
  return sums;
}
