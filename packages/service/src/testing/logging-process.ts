/** A program under test: a Node process that logs JSON lines (see logger.ts) to its standard output. */
import { type ChildProcess, type SpawnOptions, spawn } from 'node:child_process';
import { once } from 'node:events';
import { createInterface } from 'node:readline';

export class LoggingProcess {
  readonly child: ChildProcess;
  /** Its exit status, once its output has also ended; null if a signal ended it. */
  readonly exited: Promise<number | null>;
  readonly #lines: AsyncIterator<string>;
  #errors = '';

  /** @param program path of the script to run */
  constructor(program: string, args: string[], options: Pick<SpawnOptions, 'cwd' | 'env'> = {}) {
    const child = spawn(process.execPath, [program, ...args], {
      ...options,
      stdio: ['ignore', 'pipe', 'pipe'],
    });
    child.stderr.on('data', (data: Buffer) => {
      this.#errors += data.toString();
    });
    this.#lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
    this.exited = once(child, 'close').then(([code]) => code as number | null);
    this.child = child;
  }

  /** Everything it has written to its standard error. */
  get errors(): string {
    return this.#errors;
  }

  /**
   * The next record with this message, or one that matches the pattern; skips earlier records.
   *
   * @throws {Error} with its standard error output, if its output ends first
   */
  async logged(message: string | RegExp): Promise<Record<string, unknown>> {
    for (;;) {
      const line = await this.#lines.next();
      if (line.done === true) throw new Error(`never logged: ${String(message)}\n${this.#errors}`);
      const record = JSON.parse(line.value) as Record<string, unknown>;
      if (typeof message === 'string' ? record.msg === message : message.test(String(record.msg)))
        return record;
    }
  }
}
