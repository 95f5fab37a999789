import { type ChildProcess, spawn } from 'node:child_process';
import { createInterface } from 'node:readline';

export interface ProcessSpec {
  /** Shown before each of its lines and in errors. */
  name: string;
  /** Program and arguments; `node` means the Node that runs this. */
  command: string[];
  cwd: string;
  env?: Record<string, string> | undefined;
  /** The program is ready once this answers 200. */
  readyUrl: string;
  /** How long that may take, ms. */
  readyTimeoutMs?: number | undefined;
  onLine?: ((name: string, line: string) => void) | undefined;
  /** Whether it reads what {@link ManagedProcess.type} writes; otherwise its input is empty. */
  input?: boolean | undefined;
  /** Whether it receives messages from {@link ManagedProcess.send}. */
  ipc?: boolean | undefined;
}

/** How a child ended. */
export interface Exit {
  code: number | null;
  signal: NodeJS.Signals | null;
}

const KEPT_LINES = 200;
const STOP_TIMEOUT_MS = 8000;

/** A child process that has reported ready, whose output is kept, and that never outlives this process. */
export class ManagedProcess {
  readonly name: string;
  readonly exited: Promise<Exit>;
  readonly #child: ChildProcess;
  readonly #lines: string[] = [];
  #exit: Exit | null = null;

  private constructor(spec: ProcessSpec) {
    this.name = spec.name;
    const [program, ...args] = spec.command as [string, ...string[]];
    // A process group of its own: Ctrl-C in the terminal reaches only this process, which then stops its children in
    // order.
    this.#child = spawn(program === 'node' ? process.execPath : program, args, {
      cwd: spec.cwd,
      env: { ...process.env, ...spec.env },
      stdio: [
        spec.input === true ? 'pipe' : 'ignore',
        'pipe',
        'pipe',
        ...(spec.ipc ? (['ipc'] as const) : []),
      ],
      detached: process.platform !== 'win32',
    });
    for (const stream of [this.#child.stdout, this.#child.stderr]) {
      if (stream === null) continue;
      createInterface({ input: stream }).on('line', (line) => {
        this.#lines.push(line);
        if (this.#lines.length > KEPT_LINES) this.#lines.shift();
        spec.onLine?.(spec.name, line);
      });
    }
    this.exited = new Promise((resolve) => {
      this.#child.once('error', (error) => {
        this.#lines.push(error.message);
        this.#exit ??= { code: null, signal: null };
        resolve(this.#exit);
      });
      this.#child.once('exit', (code, signal) => {
        this.#exit = { code, signal };
        resolve(this.#exit);
      });
    });
    process.once('exit', this.#killGroup);
    void this.exited.then(() => process.off('exit', this.#killGroup));
  }

  /**
   * Starts a program and waits until it is ready.
   *
   * @throws {Error} naming the program, with its last lines, if it ends or is not ready in time
   */
  static async start(spec: ProcessSpec): Promise<ManagedProcess> {
    const started = new ManagedProcess(spec);
    const deadline = Date.now() + (spec.readyTimeoutMs ?? 30_000);
    for (;;) {
      if (started.#exit !== null) throw started.#failure('ended before it was ready');
      if (await answers(spec.readyUrl)) return started;
      if (Date.now() > deadline) {
        await started.kill();
        throw started.#failure(`not ready in time (${spec.readyUrl} does not answer)`);
      }
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  }

  get pid(): number {
    return this.#child.pid ?? -1;
  }

  get running(): boolean {
    return this.#exit === null;
  }

  /** Its last lines of output. */
  get output(): string {
    return this.#lines.join('\n');
  }

  /** Writes to the input of a program started with `input`. @param text `null` ends it */
  type(text: string | null): void {
    if (text === null) this.#child.stdin?.end();
    else this.#child.stdin?.write(text);
  }

  /** Sends a message to a program started with `ipc`; messages that it cannot receive are lost. */
  send(message: object): void {
    if (this.running && this.#child.connected) this.#child.send(message);
  }

  /** Asks it to end (SIGTERM), and kills it (SIGKILL) if it does not. */
  async stop(): Promise<Exit> {
    if (this.#exit !== null) return this.#exit;
    this.#child.kill('SIGTERM');
    const timer = setTimeout(this.#killGroup, STOP_TIMEOUT_MS);
    const exit = await this.exited;
    clearTimeout(timer);
    return exit;
  }

  /** Sends it a signal; see {@link exited} for how it ends. */
  signal(signal: NodeJS.Signals): void {
    this.#child.kill(signal);
  }

  /** Kills it at once, as a crash or a power cut would. */
  async kill(): Promise<Exit> {
    this.#killGroup();
    return this.exited;
  }

  readonly #killGroup = (): void => {
    if (this.#exit !== null || this.#child.pid === undefined) return;
    try {
      process.kill(process.platform === 'win32' ? this.#child.pid : -this.#child.pid, 'SIGKILL');
    } catch {
      // It ended in between.
    }
  };

  #failure(what: string): Error {
    return new Error(`${this.name}: ${what}\n${this.output}`);
  }
}

async function answers(url: string): Promise<boolean> {
  try {
    const response = await fetch(url, { signal: AbortSignal.timeout(1000) });
    await response.arrayBuffer();
    return response.ok;
  } catch {
    return false;
  }
}
