import type { Intervention, ObstacleGuardState } from '@farpoint/protocol';
import type { CollisionState } from '@farpoint/safety';

/** What the obstacle guard knows at an instant. Times in ms, infinite for what never came. */
export interface GuardReport {
  state: ObstacleGuardState;
  /** Whether somebody drives. */
  driven: boolean;
  sensors: readonly GuardedSensorReport[];
  odometryAgeMs: number;
  /** Why its newest answer was less than the wish. */
  reason: Intervention | null;
  /** What another program demands; `null` if none is asked. */
  collision: CollisionState | null;
  /** How often the thread that hears its topics was replaced. */
  restarts: number;
}

export interface GuardedSensorReport {
  /** The sensor's, or its topic. */
  name: string;
  /** Of the newest cloud or scan. */
  ageMs: number;
  silent: boolean;
  /** Whether it should give something now. */
  isExpected: boolean;
  /** How many were judged, and how long the last took. */
  grids: number;
  lastMs: number;
}

/** For `/healthz`: not well while something that should say where obstacles are says nothing. */
export function guardHealth(report: GuardReport): { ok: boolean; detail: Record<string, unknown> } {
  const { state, sensors, odometryAgeMs, reason, collision, restarts } = report;
  const missing = sensors.some(({ silent, isExpected }) => silent && isExpected);
  return {
    ok: !missing && collision !== 'silent',
    detail: {
      state,
      reason,
      odometryAgeMs: rounded(odometryAgeMs),
      ...(collision === null ? {} : { collision }),
      ...(restarts === 0 ? {} : { restarts }),
      sensors: sensors.map(({ name, ageMs, silent, isExpected, lastMs }) => ({
        name,
        says: silent ? (isExpected ? 'silent' : 'not asked') : 'live',
        ageMs: rounded(ageMs),
        lastMs: rounded(lastMs),
      })),
    },
  };
}

/** `null` for what never came. */
function rounded(ms: number): number | null {
  return Number.isFinite(ms) ? Math.round(ms * 100) / 100 : null;
}
