import type { StageTimings } from '@farpoint/protocol';

const STAGES = ['captureMs', 'sampleMs', 'packMs', 'sendMs'] as const;
export type Stage = (typeof STAGES)[number];

/** Mean time of each stage since the last query. */
export class StageTimer {
  readonly #sums: Record<Stage, { total: number; count: number }> = {
    captureMs: { total: 0, count: 0 },
    sampleMs: { total: 0, count: 0 },
    packMs: { total: 0, count: 0 },
    sendMs: { total: 0, count: 0 },
  };
  #last: StageTimings = { captureMs: 0, sampleMs: 0, packMs: 0, sendMs: 0 };

  add(stage: Stage, ms: number): void {
    this.#sums[stage].total += ms;
    this.#sums[stage].count++;
  }

  /** A stage without a frame since the last query keeps its mean. */
  take(): StageTimings {
    const means = { ...this.#last };
    for (const stage of STAGES) {
      const sum = this.#sums[stage];
      if (sum.count === 0) continue;
      means[stage] = sum.total / sum.count;
      sum.total = 0;
      sum.count = 0;
    }
    this.#last = means;
    return means;
  }
}
