import { once } from 'node:events';
import { WebSocket } from 'ws';
import { inTime } from './harm.ts';

type Json = Record<string, unknown>;

/** A WebSocket that sends anything, and whose messages can be waited for. */
export class RawSocket {
  readonly socket: WebSocket;
  readonly #inbox: Json[] = [];
  readonly #waiting = new Set<() => void>();
  closeCode: number | null = null;

  private constructor(url: string) {
    this.socket = new WebSocket(url, { perMessageDeflate: false });
    this.socket.on('error', () => undefined);
    this.socket.on('message', (data: Buffer, binary: boolean) => {
      if (!binary) this.#inbox.push(JSON.parse(data.toString()) as Json);
      this.#wake();
    });
    this.socket.on('close', (code) => {
      this.closeCode = code;
      this.#wake();
    });
  }

  static async open(url: string): Promise<RawSocket> {
    const raw = new RawSocket(url);
    await inTime(once(raw.socket, 'open'), `${new URL(url).pathname} opens no WebSocket`);
    return raw;
  }

  /** A message as an object, or as it is. */
  send(message: Json | string | Uint8Array): void {
    if (this.socket.readyState !== WebSocket.OPEN) return;
    const raw = typeof message === 'string' || message instanceof Uint8Array;
    this.socket.send(raw ? message : JSON.stringify(message));
  }

  /** The next message of this type; skips others. @throws {HarmError} if none comes */
  async next(type: string): Promise<Json> {
    const found = async () => {
      for (;;) {
        const at = this.#inbox.findIndex((message) => message.type === type);
        if (at >= 0) return this.#inbox.splice(0, at + 1).at(-1) as Json;
        if (this.closeCode !== null) throw new Error(`closed (${this.closeCode}) before ${type}`);
        await new Promise<void>((resolve) => this.#waiting.add(resolve));
      }
    };
    return inTime(found(), `no ${type}`);
  }

  /** Resolves once everything sent before has been handled, or the socket has been closed. */
  async handled(): Promise<void> {
    if (this.socket.readyState !== WebSocket.OPEN) return;
    const answered = once(this.socket, 'pong');
    this.socket.ping();
    await inTime(
      Promise.race([answered, once(this.socket, 'close')]),
      'a socket is neither answered nor closed',
    );
  }

  close(): void {
    this.socket.terminate();
  }

  #wake(): void {
    for (const wake of this.#waiting) wake();
    this.#waiting.clear();
  }
}
