import { CapacityError, type CapacitySpec, type CapacityStep } from './capacity.ts';

/** What follows the last sample of a trace: the first sample again, or the last one for ever. */
export type TraceEnd = 'loop' | 'hold';

const HEADER = /^\s*time_s\s*,\s*capacity_mbps\s*$/;

/**
 * Reads a capacity trace: CSV `time_s,capacity_mbps` with increasing times. Lines beginning with # are comments, the
 * header is optional. A sample holds until the next; the last one for as long as the one before it.
 *
 * @throws {CapacityError} naming the line
 */
export function parseTrace(text: string, end: TraceEnd = 'loop'): CapacitySpec {
  const samples: CapacityStep[] = [];
  const lines = text.split(/\r?\n/);
  for (const [index, line] of lines.entries()) {
    if (line.trim() === '' || line.startsWith('#')) continue;
    if (samples.length === 0 && HEADER.test(line)) continue;
    const cells = line.split(',').map((cell) => (cell.trim() === '' ? Number.NaN : Number(cell)));
    const [seconds, mbps] = cells;
    if (cells.length !== 2 || !Number.isFinite(seconds) || !Number.isFinite(mbps) || mbps! < 0) {
      throw new CapacityError(`trace line ${index + 1}: must be \`time_s,capacity_mbps\`, two numbers`);
    }
    const atMs = Math.round(seconds! * 1e6) / 1000;
    const before = samples.at(-1);
    if (before !== undefined && atMs <= before.atMs) {
      throw new CapacityError(`trace line ${index + 1}: its time is not after the line before it`);
    }
    samples.push({ atMs, mbps: mbps! });
  }
  const first = samples[0];
  const last = samples.at(-1);
  if (first === undefined || last === undefined) throw new CapacityError('trace: has no samples');
  const steps = samples.map(({ atMs, mbps }) => ({ atMs: atMs - first.atMs, mbps }));
  if (end === 'hold' || samples.length === 1) return { steps, periodMs: null };
  const lastLength = last.atMs - samples.at(-2)!.atMs;
  return { steps, periodMs: last.atMs - first.atMs + lastLength };
}
