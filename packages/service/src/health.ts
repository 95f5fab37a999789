/** One aspect of a program's health. */
export interface HealthCheck {
  readonly ok: boolean;
  /** Whatever helps who looks: counts, ages, a reason. Must be JSON. */
  readonly detail?: unknown;
}

export interface HealthReport {
  readonly status: 'ok' | 'failing' | 'stopping';
  readonly uptimeSeconds: number;
  readonly checks: Readonly<Record<string, HealthCheck>>;
}

/** What `/healthz` says: ok while every check is, and failing checks by name where not. */
export class Health {
  readonly #checks = new Map<string, () => HealthCheck>();
  readonly #now: () => number;
  readonly #startedAt: number;
  #stopping = false;

  constructor(now: () => number = () => performance.now()) {
    this.#now = now;
    this.#startedAt = now();
  }

  /** Adds a check, asked anew for each report. One that throws counts as failing. */
  add(name: string, check: () => HealthCheck): void {
    this.#checks.set(name, check);
  }

  /** From here on the program is on its way out and wants no new work. */
  stopping(): void {
    this.#stopping = true;
  }

  report(): HealthReport {
    const checks: Record<string, HealthCheck> = {};
    let ok = true;
    for (const [name, check] of this.#checks) {
      try {
        checks[name] = check();
      } catch (error) {
        checks[name] = { ok: false, detail: error instanceof Error ? error.message : String(error) };
      }
      ok &&= checks[name].ok;
    }
    return {
      status: this.#stopping ? 'stopping' : ok ? 'ok' : 'failing',
      uptimeSeconds: Math.round((this.#now() - this.#startedAt) / 1000),
      checks,
    };
  }
}
