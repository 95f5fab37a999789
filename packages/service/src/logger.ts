import { type DestinationStream, destination, type Logger, pino } from 'pino';
import { formatLogLine } from './log-format.ts';
import type { CommonValues } from './option-table.ts';

export type { Logger } from 'pino';

export interface LoggerOptions {
  /** Said in every line, e.g. `signaling`. */
  name: string;
  level: CommonValues['logLevel'];
  format: CommonValues['logFormat'];
  /** Default: standard output, written at once so that nothing is lost at exit. */
  stream?: DestinationStream & { isTTY?: boolean };
}

/** One JSON object a line for machines, or one readable line on a terminal. Errors go under the key `err`. */
export function createLogger(options: LoggerOptions): Logger {
  const tty = options.stream === undefined ? process.stdout.isTTY === true : options.stream.isTTY === true;
  const out = options.stream ?? destination({ dest: 1, sync: true });
  const readable = options.format === 'text' || (options.format === 'auto' && tty);
  return pino(
    {
      level: options.level,
      base: { name: options.name },
      timestamp: pino.stdTimeFunctions.isoTime,
      formatters: { level: (label) => ({ level: label }) },
    },
    readable ? { write: (line) => void out.write(formatLogLine(line, tty)) } : out,
  );
}

/** A logger that says nothing, for tests and libraries without one. */
export function silentLogger(): Logger {
  return pino({ level: 'silent' });
}
