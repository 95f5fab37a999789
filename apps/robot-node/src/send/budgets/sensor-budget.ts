/** How much one sensor may capture, and in which formats, for all who get its clouds. Pure. */
import {
  type CaptureBudget,
  type CodedBudget,
  NO_BUDGET,
  UNSENT_BUDGET,
} from '../../sense/encode/capture-budget.ts';
import { CODED_FORMATS, type CodedFormat, type DrawnMost } from '../../sense/encode/plan.ts';
import type { StreamSender } from '../transport/stream-sender.ts';

/** A receiver of clouds, as far as it decides how much is captured. */
export interface BudgetTarget {
  /** The name by which the guard knows the operator. */
  readonly id: string;
  readonly streaming: boolean;
  /** Whether the operator wants this sensor's clouds. */
  wants(sensor: number): boolean;
  /** How much of the operator's path this sensor's clouds may take, bit/s on the wire. */
  cloudBitsPerSecond(sensor: number): number;
  /** Whether this sensor's frames are enlarged when the path's rate control probes for a higher rate. */
  probesWith(sensor: number): boolean;
  reads(format: CodedFormat): boolean;
  readonly sender: Pick<StreamSender, 'probeWish' | 'overheadBytes'> | null;
  /** The most that the operator's computer draws; left out or `null`: all that comes. */
  readonly display?: DrawnMost | null;
}

export interface SensorDemand {
  /** The sensor's number. */
  sensor: number;
  /** The operator whose path decides; `null` if nobody drives. */
  driver: string | null;
  /** Whether coded formats may be used. */
  mayCode: boolean;
  /** Whether live viewers want the clouds even if no operator does. */
  wantedAnyway: boolean;
}

/**
 * The driver decides. If nobody drives, all watchers decide together: every format that any of them reads may be used, at the
 * rate of the slowest path among its readers. Operators with slower paths skip frames. Operators who cannot read a
 * frame's format get `points64` in parallel.
 */
export function sensorBudget(
  targets: Iterable<BudgetTarget>,
  { sensor, driver, mayCode, wantedAnyway }: SensorDemand,
): CaptureBudget {
  const streaming = [...targets].filter((target) => target.streaming && target.wants(sensor));
  if (streaming.length === 0) return wantedAnyway ? UNSENT_BUDGET : NO_BUDGET;
  const driving = streaming.find(({ id }) => id === driver);
  const driven = driving === undefined ? streaming : [driving];
  const coded = mayCode
    ? CODED_FORMATS.flatMap((format) => codedBudget(format, sensor, driven, streaming))
    : [];
  const readers = driven.filter((target) => coded.some(({ format }) => target.reads(format)));
  const deciding = readers.length > 0 ? readers : driven;
  const display = mostDrawn(deciding);
  return {
    coded,
    ...(display === null ? {} : { display }),
    targetBitsPerSecond: narrowest(deciding, sensor),
    probe: probeOf(deciding, sensor),
    overheadBytes: Math.max(0, ...streaming.map((target) => target.sender?.overheadBytes ?? 0)),
    streaming: true,
    ...(driving === undefined ? {} : { prompt: true }),
  };
}

/** Only one path can be probed at a time, because the enlarged frames go to everyone. */
function probeOf(deciding: readonly BudgetTarget[], sensor: number): CaptureBudget['probe'] {
  const [only] = deciding;
  if (only === undefined || deciding.length > 1 || !only.probesWith(sensor)) return null;
  const wish = only.sender?.probeWish ?? null;
  return wish === null ? null : { clusterId: wish.clusterId, bytes: wish.bytes };
}

/** What the fastest of them draws; `null` if one draws all that comes. */
function mostDrawn(targets: readonly BudgetTarget[]): DrawnMost | null {
  const most = { framesPerSecond: 0, points: 0 };
  for (const { display } of targets) {
    if (display == null) return null;
    most.framesPerSecond = Math.max(most.framesPerSecond, display.framesPerSecond);
    most.points = Math.max(most.points, display.points);
  }
  return targets.length === 0 ? null : most;
}

/** Empty if none of the deciding operators reads the format. */
function codedBudget(
  format: CodedFormat,
  sensor: number,
  deciding: readonly BudgetTarget[],
  streaming: readonly BudgetTarget[],
): CodedBudget[] {
  const readers = deciding.filter((target) => target.reads(format));
  if (readers.length === 0) return [];
  const others = streaming.filter((target) => !target.reads(format));
  const plainBitsPerSecond = others.length === 0 ? null : narrowest(others, sensor);
  return [{ format, targetBitsPerSecond: narrowest(readers, sensor), plainBitsPerSecond }];
}

function narrowest(targets: readonly BudgetTarget[], sensor: number): number {
  return Math.min(...targets.map((target) => target.cloudBitsPerSecond(sensor)));
}
