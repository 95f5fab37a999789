/** Analyses a run over an emulated link: pure functions of the records from the link, the robot and the page. */
import { BitRate } from '@farpoint/timing';

/** One line of `farpoint-link --stats`: one direction in 100 ms. */
export interface LinkBin {
  /** Start of the bin on CLOCK_MONOTONIC, ms. */
  timeMs: number;
  /** Mean; `null` without a bottleneck. */
  capacityMbps: number | null;
  offeredBytes: number;
  deliveredBytes: number;
  crossBytes: number;
  deliveredPackets: number;
  queueMsMean: number;
  queueMsMax: number;
  drops: Record<string, number>;
}

export const BIN_MS = 100;

/** A time span on the same clock, ms. */
export interface TimeSpan {
  fromMs: number;
  toMs: number;
}

/** Below this capacity a link carries no stream, Mbit/s. */
const DEAD_MBPS = 0.5;
/** Service that is shorter than this does not end an outage, and shorter silence does not begin one, ms. */
const BLIP_MS = 300;
const LEAST_OUTAGE_MS = 1500;

/** The times at which the link carried nothing. */
export function outagesOf(bins: readonly Pick<LinkBin, 'timeMs' | 'capacityMbps'>[]): TimeSpan[] {
  const spans: TimeSpan[] = [];
  for (const { timeMs, capacityMbps } of bins) {
    if (capacityMbps === null || capacityMbps >= DEAD_MBPS) continue;
    const last = spans.at(-1);
    if (last !== undefined && timeMs - last.toMs <= BLIP_MS) last.toMs = timeMs + BIN_MS;
    else spans.push({ fromMs: timeMs, toMs: timeMs + BIN_MS });
  }
  return spans.filter(({ fromMs, toMs }) => toMs - fromMs >= LEAST_OUTAGE_MS);
}

/** Share of the capacity used by the peers' packets. What a competing flow uses counts as available to them. */
export function utilisationOf(bins: readonly LinkBin[]): number {
  let bytes = 0;
  let capacity = 0;
  for (const bin of bins) {
    if (bin.capacityMbps === null) continue;
    bytes += bin.deliveredBytes;
    capacity += BitRate.bytesIn(BitRate.fromMbps(bin.capacityMbps), BIN_MS);
  }
  return bytes / capacity;
}

/** Share of the delivered bytes that belonged to the peers rather than to a competing flow. */
export function shareOf(bins: readonly LinkBin[]): number {
  const own = bins.reduce((sum, bin) => sum + bin.deliveredBytes, 0);
  const cross = bins.reduce((sum, bin) => sum + bin.crossBytes, 0);
  return own / (own + cross);
}

/** Queueing delay over all packets, with the resolution of the bins: each packet counts with its bin's mean. */
export function queueQuantiles(bins: readonly LinkBin[]): {
  p50: number;
  p95: number;
  p99: number;
  max: number;
} {
  const sorted = bins.filter((bin) => bin.deliveredPackets > 0).sort((a, b) => a.queueMsMean - b.queueMsMean);
  const total = sorted.reduce((sum, bin) => sum + bin.deliveredPackets, 0);
  const at = (q: number) => {
    let passed = 0;
    for (const bin of sorted) {
      passed += bin.deliveredPackets;
      if (passed >= q * total) return bin.queueMsMean;
    }
    return Number.NaN;
  };
  return {
    p50: at(0.5),
    p95: at(0.95),
    p99: at(0.99),
    max: bins.reduce((most, bin) => Math.max(most, bin.queueMsMax), 0),
  };
}

/** Longest continuous time for which the queueing delay exceeded `limitMs`, ms. */
export function longestQueueAbove(bins: readonly LinkBin[], limitMs: number): number {
  let longest = 0;
  let current = 0;
  for (const bin of bins) {
    current = bin.queueMsMax > limitMs ? current + BIN_MS : 0;
    longest = Math.max(longest, current);
  }
  return longest;
}

/** A step changes the capacity permanently by at least this factor … */
const STEP_FACTOR = 1.5;
/** … comparing the means over this long before and after. */
const STEP_MS = 3000;
/** Time over which delivery is averaged. */
const SMOOTH_MS = 500;

export interface CapacityRise {
  timeMs: number;
  fromMbps: number;
  toMbps: number;
  /** Time until 90 % of the new capacity was used; `null`: not before the next change or the end. */
  recoverySeconds: number | null;
}

/** Upward steps of the capacity, and how long it took to use them. A capacity that varies all the time has none. */
export function capacityRises(bins: readonly LinkBin[]): CapacityRise[] {
  const side = STEP_MS / BIN_MS;
  const capacity = bins.map((bin) => bin.capacityMbps ?? Number.NaN);
  const rises: CapacityRise[] = [];
  // The bin before may contain the change itself.
  for (let i = side + 1; i + side <= bins.length; i++) {
    const before = capacity.slice(i - 1 - side, i - 1);
    const after = capacity.slice(i, i + side);
    // Steps only: the capacity must be constant on both sides.
    if (Math.max(...before) > Math.min(...before) * 1.02 || Math.max(...after) > Math.min(...after) * 1.02)
      continue;
    const [fromMbps, toMbps] = [before[0] as number, after[0] as number];
    if (!(toMbps >= fromMbps * STEP_FACTOR)) continue;
    const timeMs = (bins[i] as LinkBin).timeMs;
    if (timeMs - (rises.at(-1)?.timeMs ?? Number.NEGATIVE_INFINITY) < STEP_MS) continue;
    rises.push({ timeMs, fromMbps, toMbps, recoverySeconds: recovery(bins, i, toMbps) });
  }
  return rises;
}

function recovery(bins: readonly LinkBin[], from: number, capacityMbps: number): number | null {
  const window = SMOOTH_MS / BIN_MS;
  for (let i = from; i + window <= bins.length; i++) {
    const span = bins.slice(i, i + window);
    if (span.some((bin) => Math.abs((bin.capacityMbps ?? 0) - capacityMbps) > 0.02 * capacityMbps))
      return null;
    const bytes = span.reduce((sum, bin) => sum + bin.deliveredBytes, 0);
    if (BitRate.toMbps(BitRate.of(bytes, SMOOTH_MS)) >= 0.9 * capacityMbps)
      return ((i + window - from) * BIN_MS) / 1000;
  }
  return null;
}

/** One line of the `streams.jsonl` that a robot writes with `--measure`. */
export interface RobotSample {
  timeMs: number;
  session: string;
  estimateBitsPerSecond: number;
  targetBitsPerSecond: number;
  bytesSent: number;
  packetsSent: number;
  framesDropped: number;
  pointsPerFrame: number;
  framesPerSecond: number;
  queueMs: number;
  lossFraction: number;
  state: string;
  speed: number;
  turn: number;
}

/** The page's records every 100 ms, on the robot's clock. Totals since its session began. */
export interface PageSample {
  timeMs: number;
  packetsReceived: number;
  packetsLost: number;
  framesDrawn: number;
  pointsDrawn: number;
  session: string;
  link: string;
}

export interface Outage {
  startS: number;
  endS: number;
  /** From the outage's start until the robot stood still; `null` if it never did. */
  stoppedAfterMs: number | null;
  /** From the outage's end until points resumed; `null` if they did not within the run. */
  resumedAfterMs: number | null;
  /** The page's texts about the link in the meantime. */
  words: string[];
}

const STANDING = 0.01;

export function describeOutages(
  spans: readonly TimeSpan[],
  robot: readonly { timeMs: number; speed: number; turn: number }[],
  page: readonly PageSample[],
  zeroMs: number,
): Outage[] {
  return spans.map(({ fromMs, toMs }) => {
    const during = robot.filter(({ timeMs }) => timeMs >= fromMs && timeMs < toMs);
    const stood = during.find(({ speed, turn }) => Math.abs(speed) < STANDING && Math.abs(turn) < STANDING);
    let resumedMs: number | null = null;
    for (let i = 1; i < page.length; i++) {
      const [last, now] = [page[i - 1] as PageSample, page[i] as PageSample];
      if (now.timeMs < toMs) continue;
      // Totals restart with a new session.
      const came =
        now.packetsReceived - (now.packetsReceived < last.packetsReceived ? 0 : last.packetsReceived);
      if (came > 0 && now.session === 'live') {
        resumedMs = now.timeMs;
        break;
      }
    }
    return {
      startS: round((fromMs - zeroMs) / 1000),
      endS: round((toMs - zeroMs) / 1000),
      stoppedAfterMs: stood === undefined ? null : Math.round(stood.timeMs - fromMs),
      resumedAfterMs: resumedMs === null ? null : Math.round(resumedMs - toMs),
      words: [
        ...new Set(
          page
            .filter(({ timeMs }) => timeMs >= fromMs && timeMs < toMs)
            .map(({ link }) => link.replaceAll(/\d+/g, 'N')),
        ),
      ],
    };
  });
}

/** Growth of totals that may restart. */
export function grown(values: readonly number[]): number {
  let sum = 0;
  for (let i = 1; i < values.length; i++) {
    const [last, now] = [values[i - 1] as number, values[i] as number];
    sum += now >= last ? now - last : now;
  }
  return sum;
}

export function isWithin(spans: readonly TimeSpan[], fromMs: number, toMs: number): boolean {
  return spans.some((span) => fromMs < span.toMs && toMs > span.fromMs);
}

function round(value: number): number {
  return Number(value.toFixed(1));
}

/** The largest; `null` if any is `null`. */
export function worst(times: readonly (number | null)[]): number | null {
  return times.some((time) => time === null) ? null : Math.max(...(times as number[]));
}
