import { type DestinationStream, destination, type Logger, pino } from 'pino';
import { isJournal, toJournal } from './journal.ts';
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

/**
 * One JSON object a line for machines, or one readable line on a terminal. Errors go under the key `err`, what helps under
 * `remedy`. In systemd's journal each line has its level as priority.
 */
export function createLogger(options: LoggerOptions): Logger {
  const tty = options.stream === undefined ? process.stdout.isTTY === true : options.stream.isTTY === true;
  const out = options.stream ?? standardOutput();
  const readable = options.format === 'text' || (options.format === 'auto' && tty);
  return pino(
    {
      level: options.level,
      base: { name: options.name },
      timestamp: pino.stdTimeFunctions.isoTime,
      formatters: { level: (label) => ({ level: label }) },
      // Causes stand beside the error: pino's own way puts all their messages and stacks into one.
      serializers: { err: pino.stdSerializers.errWithCause },
    },
    readable ? { write: (line) => void out.write(formatLogLine(line, tty)) } : out,
  );
}

function standardOutput(): DestinationStream {
  const out = destination({ dest: 1, sync: true });
  return isJournal(process.env.JOURNAL_STREAM, 1) ? toJournal(out) : out;
}

/** A logger that says nothing, for tests and libraries without one. */
export function silentLogger(): Logger {
  return pino({ level: 'silent' });
}
