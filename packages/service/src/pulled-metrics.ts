import { Counter, Gauge, type Registry } from 'prom-client';

/** One metric's values by the value of its label. */
export type LabelledValues = Iterable<readonly [label: string, value: number]>;

/** Metrics whose values live elsewhere and are read when somebody asks for `/metrics`. */
export class PulledMetrics {
  readonly #registers: Registry[];
  readonly #prefix: string;

  /** @param prefix of every name, e.g. `farpoint_robot` */
  constructor(registry: Registry, prefix: string) {
    this.#registers = [registry];
    this.#prefix = prefix;
  }

  /** A sum since the start; its name gets `_total`. */
  sum(name: string, help: string, read: () => number): void {
    new Counter({
      ...this.#identity(`${name}_total`, help),
      collect() {
        this.reset();
        this.inc(read());
      },
    });
  }

  /** Sums since the start, by the values of one label; its name gets `_total`. */
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

  /** A value that rises and falls. */
  gauge(name: string, help: string, read: () => number): void {
    new Gauge({
      ...this.#identity(name, help),
      collect() {
        this.set(read());
      },
    });
  }

  /** Values that rise and fall, by the values of one label; those of the same label value are added up. */
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
