/** A program as a test runs it: a Node process that logs JSON lines (see logger.ts) on its standard output. */
import { type ChildProcess, type SpawnOptions, spawn } from 'node:child_process';
import { once } from 'node:events';
import { createInterface } from 'node:readline';

export class LoggingProcess {
  readonly child: ChildProcess;
  /** Its exit status, once its output has ended too; null where a signal ended it. */
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

  /** All that it has written on its standard error. */
  get errors(): string {
    return this.#errors;
  }

  /**
   * The next record with this message, or one that the pattern fits; those before it are passed over.
   *
   * @throws {Error} with what it wrote on its standard error, where its output ends first
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
