import { existsSync, readFileSync, writeFileSync } from 'node:fs';

/** Where {@link FaultTimes.save} adds to, if it is set. */
export const TIMES_FILE = 'FARPOINT_FAULT_TIMES';

export interface FaultTime {
  fault: string;
  /** From the cause to the first lower velocity that the wheels are told. */
  brakingAfterMs: number;
  /** What it may take, and for how long the test itself did not look. */
  limitMs: number;
  ok: boolean;
}

/** How soon the robot braked after each fault. */
export class FaultTimes {
  readonly rows: FaultTime[] = [];

  add(fault: string, brakingAfterMs: number, limitMs: number): void {
    this.rows.push({ fault, brakingAfterMs, limitMs, ok: brakingAfterMs <= limitMs });
  }

  text(): string {
    return this.rows
      .map(({ fault, brakingAfterMs }) => `${brakingAfterMs.toFixed(0).padStart(5)}  ${fault}`)
      .join('\n');
  }

  /** Adds the rows to a file of JSON for `pnpm bench faults`. */
  save(): void {
    const file = process.env[TIMES_FILE];
    if (file === undefined || file === '') return;
    const before: FaultTime[] = existsSync(file) ? JSON.parse(readFileSync(file, 'utf8')) : [];
    writeFileSync(file, JSON.stringify([...before, ...this.rows]));
  }
}
