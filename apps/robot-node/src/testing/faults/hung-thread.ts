/** Stops one thread of a running program, as if it hung: ptrace, by python3. */
import { type ChildProcessByStdio, spawn, spawnSync } from 'node:child_process';
import { once } from 'node:events';
import { readdirSync, readFileSync } from 'node:fs';
import type { Readable, Writable } from 'node:stream';

/** Seizes the thread, stops it at the first line of its input, and lets it go at the end. Says so each time. */
const SCRIPT = `
import ctypes, os, sys
ptrace = ctypes.CDLL(None, use_errno=True).ptrace
ptrace.argtypes = [ctypes.c_long] * 4
thread = int(sys.argv[1])
PTRACE_SEIZE, PTRACE_INTERRUPT = 0x4206, 0x4207
WALL = 0x40000000
def ask(request):
    if ptrace(request, thread, 0, 0) != 0:
        sys.exit(os.strerror(ctypes.get_errno()))
ask(PTRACE_SEIZE)
print('seized', flush=True)
sys.stdin.readline()
ask(PTRACE_INTERRUPT)
os.waitpid(thread, WALL)
print('stopped', flush=True)
sys.stdin.read()
`;

/** Whether this machine lets a program stop another's threads. */
export function canHangThreads(): boolean {
  const trial = `import os, sys, time
if (child := os.fork()) == 0: time.sleep(10); os._exit(0)
sys.argv = ['-', str(child)]
sys.stdin = open(os.devnull)
try: exec(${JSON.stringify(SCRIPT)})
finally: os.kill(child, 9)`;
  return spawnSync('python3', ['-c', trial], { stdio: 'ignore', timeout: 10_000 }).status === 0;
}

/** A thread that can be stopped, and goes on. */
export class HungThread {
  readonly #tracer: ChildProcessByStdio<Writable, Readable, null>;
  readonly #ended: Promise<unknown[]>;

  private constructor(thread: string) {
    this.#tracer = spawn('python3', ['-c', SCRIPT, thread], { stdio: ['pipe', 'pipe', 'inherit'] });
    this.#ended = once(this.#tracer, 'exit');
  }

  /**
   * Prepares to stop a thread; it goes on.
   *
   * @param name of the thread, as `ps -L -o comm` shows it
   */
  static async seize(pid: number, name: string): Promise<HungThread> {
    const id = readdirSync(`/proc/${pid}/task`).find(
      (thread) => readFileSync(`/proc/${pid}/task/${thread}/comm`, 'utf8').trim() === name,
    );
    if (id === undefined) throw new Error(`the program ${pid} has no thread \`${name}\``);
    const thread = new HungThread(id);
    await thread.#says('seized');
    return thread;
  }

  /** Resolves when the thread stands still. */
  async stop(): Promise<void> {
    this.#tracer.stdin.write('\n');
    await this.#says('stopped');
  }

  async goOn(): Promise<void> {
    this.#tracer.stdin.end();
    await this.#ended;
  }

  async #says(word: string): Promise<void> {
    const [said] = await Promise.race([once(this.#tracer.stdout, 'data'), this.#ended]);
    if (String(said).trim() !== word) throw new Error(`a thread could not be stopped: ${said}`);
  }
}
