import { WebSocket } from 'ws';
import { Inbox } from './inbox.ts';

/** A plain WebSocket of the reference system for tests: text and bytes as received. */
export class SocketPeer {
  readonly inbox = new Inbox<string | Uint8Array>();
  /** Resolves when either side has closed it. */
  readonly closed: Promise<void>;
  readonly #socket: WebSocket;

  private constructor(socket: WebSocket) {
    this.#socket = socket;
    this.closed = new Promise((resolve) => socket.once('close', () => resolve()));
    socket.on('message', (data: Buffer, binary: boolean) =>
      this.inbox.push(binary ? new Uint8Array(data) : data.toString('utf8')),
    );
    socket.on('error', () => undefined);
  }

  /** @throws {Error} if nobody answers */
  static async open(url: string, origin?: string): Promise<SocketPeer> {
    const socket = new WebSocket(url, origin === undefined ? {} : { origin });
    const peer = new SocketPeer(socket);
    await new Promise<void>((resolve, reject) => {
      socket.once('open', () => resolve());
      socket.once('error', reject);
    });
    return peer;
  }

  get open(): boolean {
    return this.#socket.readyState === WebSocket.OPEN;
  }

  send(message: unknown): void {
    this.sendRaw(JSON.stringify(message));
  }

  sendRaw(data: string | Uint8Array): void {
    if (this.open) this.#socket.send(data);
  }

  /** The next JSON message that has these members. */
  async message<T extends object>(like: object, timeoutMs?: number): Promise<T> {
    const what = JSON.stringify(like);
    const text = await this.inbox.next(
      (data) => typeof data === 'string' && matches(data, like),
      timeoutMs,
      what,
    );
    return JSON.parse(text as string) as T;
  }

  async bytes(timeoutMs?: number): Promise<Uint8Array> {
    return (await this.inbox.next(
      (data) => typeof data !== 'string',
      timeoutMs,
      'a binary message',
    )) as Uint8Array;
  }

  /** Stops reading. */
  pause(): void {
    this.#socket.pause();
  }

  async close(): Promise<void> {
    this.#socket.terminate();
    await this.closed;
  }
}

function matches(text: string, like: object): boolean {
  try {
    return includes(JSON.parse(text), like);
  } catch {
    return false;
  }
}

/** Whether `value` contains everything in `like`, at any depth. */
export function includes(value: unknown, like: unknown): boolean {
  if (typeof like !== 'object' || like === null) return value === like;
  if (typeof value !== 'object' || value === null) return false;
  return Object.entries(like).every(([key, part]) => includes((value as Record<string, unknown>)[key], part));
}
