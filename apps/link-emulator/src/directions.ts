/** Builds the link that the options describe. */
import type { Direction, DirectionOptions } from '@farpoint/link-emulator';
import {
  burstLossOf,
  CapacityError,
  type CapacitySpec,
  CbrFlow,
  type CrossFlow,
  constantCapacity,
  type LinkProfile,
  parseTrace,
  TcpFlow,
  unlimitedCapacity,
} from '@farpoint/network-sim';
import { OptionsError, readTextFile, TextFileError } from '@farpoint/service';
import type * as z from 'zod';
import type { DirectionalKey, directional, LinkOptions } from './options.ts';

/** The value for one direction: its own, or else the value for both. */
function optionsOf(options: LinkOptions, direction: Direction) {
  const all = options as unknown as Readonly<Record<string, unknown>>;
  return <Key extends DirectionalKey>(key: Key): z.output<(typeof directional)[Key]['schema']> =>
    (all[`${direction}${key[0]!.toUpperCase()}${key.slice(1)}`] ?? all[key] ?? null) as z.output<
      (typeof directional)[Key]['schema']
    >;
}

/** @throws {OptionsError} for faults that only show when options are combined, or a trace that cannot be read */
export function directionOf(options: LinkOptions, direction: Direction): DirectionOptions {
  const value = optionsOf(options, direction);
  const burst = value('burstLoss') ?? 0;
  const burstLength = value('burstLength') ?? 5;
  const queueBytes = value('queueBytes');
  const delayMs = value('delayMs') ?? options.rttMs / 2;
  const profile: LinkProfile = {
    capacity: capacityOf(options, direction),
    delayMs,
    jitterMs: value('jitterMs') ?? 0,
    jitterReorders: options.jitterReorders,
    tailMs: 0,
    loss: value('loss') ?? 0,
    burstLoss: burst === 0 ? null : burstOf(burst, burstLength),
    reorder: { probability: value('reorder') ?? 0, extraMs: value('reorderMs') ?? 10 },
    duplicate: value('duplicate') ?? 0,
    queue: queueBytes === null ? { ms: value('queueMs') ?? 100 } : { bytes: queueBytes },
  };
  const kind = value('cross') ?? 'none';
  const crossStartMs = (value('crossStart') ?? 0) * 1000;
  const crossFlows = (linkStartMs: number): CrossFlow[] => {
    const startMs = linkStartMs + crossStartMs;
    if (kind === 'none') return [];
    if (kind === 'cbr') return [new CbrFlow(value('crossMbps') ?? 1, startMs)];
    // Acknowledgements return over the other direction, but are not counted as its load.
    const other = direction === 'up' ? 'down' : 'up';
    const ackDelayMs = optionsOf(options, other)('delayMs') ?? options.rttMs / 2;
    return [new TcpFlow({ congestionControl: kind, startMs, ackDelayMs: Math.max(ackDelayMs, 1) })];
  };
  return { profile, crossFlows };
}

function burstOf(rate: number, length: number) {
  try {
    return burstLossOf(rate, length);
  } catch (error) {
    throw new OptionsError('--burst-loss', (error as Error).message);
  }
}

function capacityOf(options: LinkOptions, direction: Direction): CapacitySpec {
  const value = optionsOf(options, direction);
  const own = optionsOf({ ...options, rateMbps: null, steps: null, trace: null } as LinkOptions, direction);
  // An option for one direction takes precedence over any option for both, whichever form they have.
  const ofOne = own('rateMbps') !== null || own('steps') !== null || own('trace') !== null;
  const pick = ofOne ? own : value;
  const [trace, list, rate] = [pick('trace'), pick('steps'), pick('rateMbps')];
  if ([trace, list, rate].filter((given) => given !== null).length > 1) {
    throw new OptionsError(
      '--rate-mbps, --steps and --trace',
      'exclude each other: give one for each direction',
    );
  }
  const spans = value('outages') ?? undefined;
  const base =
    trace !== null
      ? readTrace(trace, options.traceEnd)
      : list !== null
        ? { steps: list, periodMs: null }
        : rate !== null
          ? constantCapacity(rate)
          : unlimitedCapacity;
  return spans === undefined ? base : { ...base, outages: spans };
}

function readTrace(path: string, end: 'loop' | 'hold'): CapacitySpec {
  let text: string;
  try {
    text = readTextFile(path);
  } catch (error) {
    if (error instanceof TextFileError) throw new OptionsError('--trace', error.message);
    throw error;
  }
  try {
    return parseTrace(text, end);
  } catch (error) {
    if (error instanceof CapacityError) throw new OptionsError('--trace', `${path}: ${error.message}`);
    throw error;
  }
}
