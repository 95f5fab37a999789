/** One aspect of a program's health. */
export interface HealthCheck {
  readonly ok: boolean;
  /** Details for whoever looks at it: counts, ages, a reason. Must be JSON. */
  readonly detail?: unknown;
}

export interface HealthReport {
  readonly status: 'ok' | 'failing' | 'stopping';
  readonly uptimeSeconds: number;
  readonly checks: Readonly<Record<string, HealthCheck>>;
}

/** The content of `/healthz`: ok while every check is, otherwise the failing checks by name. */
export class Health {
  readonly #checks = new Map<string, () => HealthCheck>();
  readonly #now: () => number;
  readonly #startedAt: number;
  #stopping = false;

  constructor(now: () => number = () => performance.now()) {
    this.#now = now;
    this.#startedAt = now();
  }

  /** Adds a check, which runs anew for each report. A check that throws counts as failing. */
  add(name: string, check: () => HealthCheck): void {
    this.#checks.set(name, check);
  }

  /** From now on the program is shutting down and wants no new work. */
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
