import { type DestinationStream, destination, type Logger, pino } from 'pino';
import { isJournal, toJournal } from './journal.ts';
import { formatLogLine } from './log-format.ts';
import type { CommonValues } from './option-table.ts';
import { withoutCredentials } from './secret.ts';

export type { Logger } from 'pino';

export interface LoggerOptions {
  /** Appears in every line, for example `signaling`. */
  name: string;
  level: CommonValues['logLevel'];
  format: CommonValues['logFormat'];
  /** Default: standard output, written synchronously so that nothing is lost at exit. */
  stream?: DestinationStream & { isTTY?: boolean };
}

/**
 * One JSON object per line for machines, or one readable line on a terminal. Errors are under the key `err`, remedies
 * under `remedy`. No line shows user names, passwords and tokens in URLs. In systemd's journal, each line has its level as priority.
 */
export function createLogger(options: LoggerOptions): Logger {
  const tty = options.stream === undefined ? process.stdout.isTTY === true : options.stream.isTTY === true;
  const plain = options.stream ?? standardOutput();
  // Here, where every line passes: an address may be in any message, detail or stack.
  const out = { write: (line: string) => void plain.write(withoutCredentials(line)) };
  const readable = options.format === 'text' || (options.format === 'auto' && tty);
  return pino(
    {
      level: options.level,
      base: { name: options.name },
      timestamp: pino.stdTimeFunctions.isoTime,
      formatters: { level: (label) => ({ level: label }) },
      // Causes are separate from the error: pino's default merges all their messages and stacks into one.
      serializers: { err: pino.stdSerializers.errWithCause },
    },
    readable ? { write: (line) => void out.write(formatLogLine(line, tty)) } : out,
  );
}

function standardOutput(): DestinationStream {
  const out = destination({ dest: 1, sync: true });
  return isJournal(process.env.JOURNAL_STREAM, 1) ? toJournal(out) : out;
}

/** A logger that writes nothing, for tests and for libraries used without one. */
export function silentLogger(): Logger {
  return pino({ level: 'silent' });
}
