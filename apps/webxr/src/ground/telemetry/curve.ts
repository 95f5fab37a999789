/** A curve with at most two points for each column of a chart: the smallest and the largest value, in order of time. */

export class Curve {
  /** Times, relative to the end of the window, s (0 or less), and values; `null` is a gap. */
  readonly xs: number[] = [];
  readonly ys: (number | null)[] = [];
  #columns: number;
  #fromMs = 0;
  #toMs = 0;
  #gapMs = 0;
  #column = -1;
  #lastMs = Number.NaN;
  #least = { timeMs: 0, value: 0 };
  #most = { timeMs: 0, value: 0 };

  /** @param columns of the chart: pixels, usually */
  constructor(columns = 1) {
    this.#columns = Math.max(1, columns);
  }

  set columns(columns: number) {
    this.#columns = Math.max(1, Math.floor(columns));
  }

  /** @param gapMs two points that are further apart are not connected */
  begin(fromMs: number, toMs: number, gapMs: number): void {
    this.xs.length = 0;
    this.ys.length = 0;
    this.#fromMs = fromMs;
    this.#toMs = toMs;
    // A gap narrower than a few columns could not be seen, and many of them would be many points.
    this.#gapMs = Math.max(gapMs, (2 * (toMs - fromMs)) / this.#columns);
    this.#column = -1;
    this.#lastMs = Number.NaN;
  }

  /** In order of time. */
  add(timeMs: number, value: number): void {
    const share = (timeMs - this.#fromMs) / (this.#toMs - this.#fromMs);
    const column = Math.min(this.#columns - 1, Math.max(0, Math.floor(share * this.#columns)));
    const isGap = timeMs - this.#lastMs > this.#gapMs;
    if (column !== this.#column || isGap) {
      this.#flush();
      if (isGap) this.#push((this.#lastMs + timeMs) / 2, null);
      this.#column = column;
      this.#least = { timeMs, value };
      this.#most = { timeMs, value };
    } else {
      if (value < this.#least.value) this.#least = { timeMs, value };
      if (value > this.#most.value) this.#most = { timeMs, value };
    }
    this.#lastMs = timeMs;
  }

  end(): void {
    this.#flush();
    this.#column = -1;
  }

  #flush(): void {
    if (this.#column < 0) return;
    const [first, second] =
      this.#least.timeMs <= this.#most.timeMs ? [this.#least, this.#most] : [this.#most, this.#least];
    this.#push(first.timeMs, first.value);
    if (second.value !== first.value) this.#push(second.timeMs, second.value);
  }

  #push(timeMs: number, value: number | null): void {
    this.xs.push((timeMs - this.#toMs) / 1000);
    this.ys.push(value);
  }
}
