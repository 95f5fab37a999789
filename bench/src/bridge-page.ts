/** Frames from the bridge to a page: the bridge's own record, and a process that reads its streaming socket. */
import { type ChildProcess, fork } from 'node:child_process';
import { readFileSync } from 'node:fs';
import type { BridgeProcess } from '@farpoint/local-stack';

/** A line of the bridge's `--stats`. */
export interface BridgeFrame {
  frameNumber: number;
  points: number;
  expectedPoints: number;
  lastPacketMs: number;
  emittedMs: number;
  pages: number;
}

export function readBridgeFrames(path: string): BridgeFrame[] {
  return readFileSync(path, 'utf8')
    .trimEnd()
    .split('\n')
    .map((line) => JSON.parse(line) as BridgeFrame);
}

/** A message of which the last byte has arrived, ms on the machine's clock. */
export interface Arrival {
  atMs: number;
  bytes: number;
}

export class PageReader {
  readonly #child: ChildProcess;

  constructor({ ports }: BridgeProcess) {
    // In a session of its own, so that its priority takes effect (sched(7), autogroup).
    this.#child = fork(new URL('./bridge-reader.ts', import.meta.url), [String(ports.streaming)], {
      detached: true,
    });
  }

  async connected(): Promise<void> {
    await this.#nextMessage();
  }

  /** Ends the process. @returns the messages that it has read, in order */
  async end(): Promise<Arrival[]> {
    const last = this.#nextMessage<{ arrivals: Arrival[] }>();
    this.#child.send('end');
    return (await last).arrivals;
  }

  kill(): void {
    this.#child.kill();
  }

  #nextMessage<T>(): Promise<T> {
    return new Promise((resolve, reject) => {
      this.#child.once('message', (message) => resolve(message as T));
      this.#child.once('exit', (code) => reject(new Error(`the reader ended with code ${code}`)));
    });
  }
}
