/** The browser's WebSocket and timer under {@link OperatorSignaling}. */
import type { OperatorSignaling, SignalingPort } from './operator-signaling.ts';

export class WebSocketPort implements SignalingPort {
  readonly #url: string;
  readonly #machine: () => OperatorSignaling;
  #socket: WebSocket | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(url: string, machine: () => OperatorSignaling) {
    this.#url = url;
    this.#machine = machine;
  }

  open(): void {
    this.close();
    let socket: WebSocket;
    try {
      socket = new WebSocket(this.#url);
    } catch {
      // Not a valid address, or ws: from an https: page.
      queueMicrotask(() => this.#machine().onClose());
      return;
    }
    this.#socket = socket;
    // Ignore events of a socket that has been replaced.
    const current = (act: () => void) => () => {
      if (this.#socket === socket) act();
    };
    socket.onopen = current(() => this.#machine().onOpen());
    socket.onclose = current(() => {
      this.#socket = null;
      this.#machine().onClose();
    });
    socket.onmessage = (event: MessageEvent<unknown>) => {
      if (this.#socket === socket && typeof event.data === 'string') this.#machine().onMessage(event.data);
    };
  }

  send(text: string): void {
    if (this.#socket?.readyState === WebSocket.OPEN) this.#socket.send(text);
  }

  close(): void {
    const socket = this.#socket;
    this.#socket = null;
    socket?.close();
  }

  setTimer(ms: number): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#machine().onTimer(), ms);
  }
}
