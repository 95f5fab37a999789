import { type ChildProcess, spawn } from 'node:child_process';
import type { Readable } from 'node:stream';

/** An X display without a screen (Xvfb), with its own number, that never outlives this process. */
export class VirtualDisplay {
  /** As in `DISPLAY`. */
  readonly name: string;
  readonly #child: ChildProcess;

  private constructor(child: ChildProcess, name: string) {
    this.#child = child;
    this.name = name;
  }

  /** @throws {Error} with its output if it does not start */
  static async start(width: number, height: number): Promise<VirtualDisplay> {
    // Once ready, it writes the number of the free display it found to descriptor 3.
    const args = ['-displayfd', '3', '-screen', '0', `${width}x${height}x24`, '-nolisten', 'tcp'];
    const child = spawn('Xvfb', args, { stdio: ['ignore', 'ignore', 'pipe', 'pipe'] });
    let said = '';
    child.stderr?.on('data', (data: Buffer) => {
      said = (said + data.toString()).slice(-2000);
    });
    const kill = () => child.kill('SIGKILL');
    process.once('exit', kill);
    child.once('close', () => process.off('exit', kill));
    const number = await new Promise<string>((resolve, reject) => {
      child.once('error', reject);
      child.once('close', () => reject(new Error(`Xvfb does not start\n${said}`)));
      let written = '';
      (child.stdio[3] as Readable).on('data', (data: Buffer) => {
        written += data.toString();
        if (written.endsWith('\n')) resolve(written.trim());
      });
    });
    return new VirtualDisplay(child, `:${number}`);
  }

  async stop(): Promise<void> {
    if (this.#child.exitCode !== null || this.#child.signalCode !== null) return;
    const gone = new Promise((resolve) => this.#child.once('close', resolve));
    this.#child.kill('SIGTERM');
    await gone;
  }
}
