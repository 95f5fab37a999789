/** What grew how much over the last second, from sums that are sampled now and then. */
export class RateMeter<K extends string> {
  readonly #windowMs: number;
  readonly #samples: { atMs: number; sums: Readonly<Record<K, number>> }[] = [];

  constructor(windowMs = 1000) {
    this.#windowMs = windowMs;
  }

  /** @returns per second, over the window or as much of it as there is; 0 at first */
  update(sums: Readonly<Record<K, number>>, nowMs: number): Record<K, number> {
    const samples = this.#samples;
    samples.push({ atMs: nowMs, sums: { ...sums } });
    // One sample at or before the window's beginning is kept, so that it is covered whole.
    while (samples.length > 2 && nowMs - (samples[1] as { atMs: number }).atMs >= this.#windowMs)
      samples.shift();
    const oldest = samples[0] as { atMs: number; sums: Readonly<Record<K, number>> };
    const seconds = (nowMs - oldest.atMs) / 1000;
    const rates = {} as Record<K, number>;
    for (const key of Object.keys(sums) as K[]) {
      rates[key] = seconds > 0 ? Math.max(0, sums[key] - oldest.sums[key]) / seconds : 0;
    }
    return rates;
  }
}
