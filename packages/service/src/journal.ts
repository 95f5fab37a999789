/** Lines for systemd's journal: each begins with its priority, sd-daemon(3), which the journal strips. */
import { fstatSync } from 'node:fs';
import type { DestinationStream } from 'pino';

/** syslog(3) priorities, for pino's levels from `fatal` downwards. */
const PRIORITIES: readonly (readonly [number, number])[] = [
  [60, 2],
  [50, 3],
  [40, 4],
  [30, 6],
];
const DEBUG = 7;

/**
 * Whether this descriptor is the journal. systemd states the journal's device and inode, but a program whose output was
 * redirected still has the variable.
 *
 * @param journalStream `JOURNAL_STREAM`, systemd.exec(5)
 */
export function isJournal(journalStream: string | undefined, descriptor: number): boolean {
  if (journalStream === undefined || journalStream === '') return false;
  const { dev, ino } = fstatSync(descriptor, { bigint: true });
  return journalStream === `${dev}:${ino}`;
}

/** Forwards everything written to it to `out`, preceded by its priority. */
export function toJournal(out: DestinationStream): DestinationStream {
  return {
    // Asks pino to set `lastLevel` before each line.
    [Symbol.for('pino.metadata')]: true,
    lastLevel: 0,
    write(line: string) {
      const [, priority] = PRIORITIES.find(([level]) => this.lastLevel >= level) ?? [0, DEBUG];
      out.write(`<${priority}>${line}`);
    },
  } as DestinationStream & { lastLevel: number };
}
