import { constants } from 'node:os';
import type { Logger } from 'pino';

export type Closer = () => Promise<void> | void;

export interface ShutdownOptions {
  log: Logger;
  /** For all closers together, ms. */
  deadlineMs?: number;
  /** Default: process.exit. */
  exit?: (code: number) => void;
}

const SIGNALS = ['SIGINT', 'SIGTERM'] as const;

/**
 * Ends a program once and in order: closers run one after the other, the last added first, within a common deadline. A
 * closer that fails is logged and does not prevent the others from running.
 */
export class Shutdown {
  readonly #log: Logger;
  readonly #deadlineMs: number;
  readonly #exit: (code: number) => void;
  readonly #closers: { name: string; close: Closer }[] = [];
  readonly #abort = new AbortController();
  #ending: Promise<number> | null = null;
  #code = 0;

  constructor(options: ShutdownOptions) {
    this.#log = options.log;
    this.#deadlineMs = options.deadlineMs ?? 5000;
    this.#exit = options.exit ?? ((code) => process.exit(code));
  }

  /** Aborted when shutdown begins: for loops and waits. */
  get signal(): AbortSignal {
    return this.#abort.signal;
  }

  /** Whether the program ends because it was asked to, and not because something failed. True before it ends. */
  get isAsked(): boolean {
    return this.#code === 0;
  }

  /** Adds something to close; it is closed before everything that was added earlier. */
  onClose(name: string, close: Closer): void {
    this.#closers.push({ name, close });
  }

  /** SIGINT and SIGTERM start the shutdown; a second signal exits at once with 128 + its number. */
  listen(): void {
    for (const signal of SIGNALS) process.on(signal, () => this.handleSignal(signal));
  }

  /** For SIGINT and SIGTERM, and for others that end a program. */
  handleSignal(signal: NodeJS.Signals): void {
    if (this.#ending === null) {
      void this.end(`received ${signal}`);
    } else {
      this.#log.warn({ signal }, 'second signal: exiting immediately');
      this.#exit(128 + constants.signals[signal]);
    }
  }

  /**
   * Closes everything, then exits with 0, or `code`, or 1 if a closer failed or the deadline passed. Further calls wait
   * for the first.
   */
  end(reason: string, code = 0): Promise<number> {
    if (this.#ending === null) this.#code = code;
    this.#ending ??= this.#run(reason, code);
    return this.#ending;
  }

  async #run(reason: string, code: number): Promise<number> {
    this.#log.info({ reason }, 'stopping');
    this.#abort.abort();
    let result = code;
    let current = '';
    let timer: NodeJS.Timeout | undefined;
    const deadline = new Promise<'late'>((resolve) => {
      timer = setTimeout(() => resolve('late'), this.#deadlineMs);
    });
    const closing = (async () => {
      for (const { name, close } of this.#closers.reverse()) {
        current = name;
        try {
          await close();
        } catch (error) {
          this.#log.error({ err: error, closing: name }, 'closing failed');
          result ||= 1;
        }
      }
      return 'done' as const;
    })();
    if ((await Promise.race([closing, deadline])) === 'late') {
      this.#log.error({ closing: current, deadlineMs: this.#deadlineMs }, 'not closed in time');
      result ||= 1;
    }
    clearTimeout(timer);
    this.#log.info({ code: result }, 'stopped');
    this.#exit(result);
    return result;
  }
}
