import { Counter, Gauge, type Registry } from 'prom-client';

/** One metric's values by the value of its label. */
export type LabelledValues = Iterable<readonly [label: string, value: number]>;

/** Metrics whose values are kept elsewhere and read for each request of `/metrics`. */
export class PulledMetrics {
  readonly #registers: Registry[];
  readonly #prefix: string;

  /** @param prefix of every name, for example `farpoint_robot` */
  constructor(registry: Registry, prefix: string) {
    this.#registers = [registry];
    this.#prefix = prefix;
  }

  /** A counter since the start; `_total` is appended to its name. */
  sum(name: string, help: string, read: () => number): void {
    new Counter({
      ...this.#identity(`${name}_total`, help),
      collect() {
        this.reset();
        this.inc(read());
      },
    });
  }

  /** Counters since the start, by the values of one label; `_total` is appended to their name. */
  sums(name: string, help: string, label: string, read: () => LabelledValues): void {
    new Counter({
      ...this.#identity(`${name}_total`, help),
      labelNames: [label],
      collect() {
        this.reset();
        for (const [value, count] of read()) this.inc({ [label]: value }, count);
      },
    });
  }

  /** The same by two labels. */
  sumsByTwo(
    name: string,
    help: string,
    [first, second]: readonly [string, string],
    read: () => Iterable<readonly [first: string, second: string, value: number]>,
  ): void {
    new Counter({
      ...this.#identity(`${name}_total`, help),
      labelNames: [first, second],
      collect() {
        this.reset();
        for (const [one, other, count] of read()) this.inc({ [first]: one, [second]: other }, count);
      },
    });
  }

  /** A gauge: a value that may rise and fall. */
  gauge(name: string, help: string, read: () => number): void {
    new Gauge({
      ...this.#identity(name, help),
      collect() {
        this.set(read());
      },
    });
  }

  /** Gauges, by the values of one label; entries with the same label value are added up. */
  gauges(name: string, help: string, label: string, read: () => LabelledValues): void {
    new Gauge({
      ...this.#identity(name, help),
      labelNames: [label],
      collect() {
        this.reset();
        for (const [value, count] of read()) this.inc({ [label]: value }, count);
      },
    });
  }

  #identity(name: string, help: string) {
    return { name: `${this.#prefix}_${name}`, help, registers: this.#registers };
  }
}
