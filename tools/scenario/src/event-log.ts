/** What happened in a run, in order. The same scenario with the same seed gives the same text. */
export class EventLog {
  readonly #lines: string[] = [];
  readonly #originMs: number;

  constructor() {
    this.#originMs = performance.now();
  }

  /** @param facts short, and the same in each run */
  add(what: string, facts: Readonly<Record<string, unknown>> = {}): void {
    const told = Object.entries(facts).map(([name, value]) => ` ${name}=${textOf(value)}`);
    this.#lines.push(`${(performance.now() - this.#originMs).toFixed(3)} ${what}${told.join('')}`);
  }

  get text(): string {
    return `${this.#lines.join('\n')}\n`;
  }
}

function textOf(value: unknown): string {
  return typeof value === 'number' ? String(Math.round(value * 1e6) / 1e6) : String(value);
}
