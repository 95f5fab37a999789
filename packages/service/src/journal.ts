/** Lines for systemd's journal: each begins with its priority, sd-daemon(3), which the journal takes away again. */
import { fstatSync } from 'node:fs';
import type { DestinationStream } from 'pino';

/** Of syslog(3), for pino's levels from `fatal` on down. */
const PRIORITIES: readonly (readonly [number, number])[] = [
  [60, 2],
  [50, 3],
  [40, 4],
  [30, 6],
];
const DEBUG = 7;

/**
 * Is this file the journal's? systemd tells its device and inode, and a program that was started with its output sent
 * elsewhere still has the variable.
 * @param journalStream `JOURNAL_STREAM`, systemd.exec(5)
 */
export function isJournal(journalStream: string | undefined, descriptor: number): boolean {
  if (journalStream === undefined || journalStream === '') return false;
  const { dev, ino } = fstatSync(descriptor, { bigint: true });
  return journalStream === `${dev}:${ino}`;
}

/** What is written to it goes on to `out`, its priority before it. */
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
