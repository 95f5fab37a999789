import { Backoff } from '@farpoint/timing';

export interface BridgeSocketEvents {
  onState(open: boolean): void;
  onText(text: string): void;
}

/**
 * With more than this unsent, bytes, a message would arrive too late and is dropped. Chosen: some 40
 * commands, a second.
 */
const MAX_BACKLOG = 4096;

/**
 * Wait before the bridge is asked again, ms: it doubles. Chosen: it runs on this machine, so asking costs little, and it
 * is back soon after it is started.
 */
export const BRIDGE_RETRY = { firstMs: 250, mostMs: 2000 };

/** One of the bridge's local WebSockets. Reconnects without end. */
export class BridgeSocket {
  readonly #url: string;
  readonly #events: BridgeSocketEvents;
  readonly #backoff = new Backoff({ ...BRIDGE_RETRY, random: Math.random });
  #socket: WebSocket | null = null;
  #closed = false;

  constructor(url: string, events: BridgeSocketEvents) {
    this.#url = url;
    this.#events = events;
  }

  get open(): boolean {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  start(): void {
    const socket = new WebSocket(this.#url);
    this.#socket = socket;
    socket.onopen = () => {
      this.#backoff.reset();
      this.#events.onState(true);
    };
    socket.onmessage = ({ data }: MessageEvent<unknown>) => {
      if (typeof data === 'string') this.#events.onText(data);
    };
    socket.onclose = () => {
      if (this.#closed) return;
      this.#events.onState(false);
      setTimeout(() => {
        if (!this.#closed) this.start();
      }, this.#backoff.nextMs());
    };
  }

  close(): void {
    this.#closed = true;
    this.#socket?.close();
  }

  send(text: string): void {
    const socket = this.#socket;
    if (socket?.readyState === WebSocket.OPEN && socket.bufferedAmount <= MAX_BACKLOG) socket.send(text);
  }
}
