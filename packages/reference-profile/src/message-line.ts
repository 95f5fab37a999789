/**
 * A connection to one of the reference system's signaling ports: JSON messages over a WebSocket that always reconnects.
 */

import { decodeJson, encodeJson, type JsonCodec, ProtocolError } from '@farpoint/protocol';
import { Reconnect } from '@farpoint/timing';
import { WebSocket } from 'ws';

/** The data channels of the reference profile. Two of them have the same label: who opened them distinguishes them. */
export const referenceChannels = {
  /** Operator → robot: a bare twist, UTF-8 JSON as a binary message. Opened by the robot. */
  control: { label: 'controltrack', ordered: true },
  /** Operator → robot: int32 bit/s, once for each received frame. Opened by the operator. */
  bandwidth: { label: 'bandwidth', ordered: true },
  /** Operator → robot: `start` and `stop`. Opened by the operator. */
  words: { label: 'controltrack', ordered: true, maxRetransmits: 30 },
} as const;

/** With more unsent bytes than this, the service counts as gone. Chosen: as for our own signaling. */
const MAX_BACKLOG_BYTES = 1_048_576;
/** A connection on which nothing is heard for this long despite a ping is dead, ms. */
const HEARTBEAT_MS = 5000;

export interface MessageLineOptions<In, Out> {
  /** ws:// or wss:// */
  url: string;
  incoming: JsonCodec<In>;
  outgoing: JsonCodec<Out>;
  /** PEM: certificate authorities to trust instead of the system's. */
  ca?: string | null | undefined;
}

export interface MessageLineEvents<In> {
  /** Connected, for the first time or again: identify yourself. */
  onOpen: () => void;
  onMessage: (message: In) => void;
  /** Called once until the connection is open again, however many attempts fail meanwhile. */
  onDown: (detail: string) => void;
}

export class MessageLine<In, Out> {
  /** Messages that could not be read. */
  malformed = 0;
  readonly #options: MessageLineOptions<In, Out>;
  readonly #events: MessageLineEvents<In>;
  readonly #reconnect = new Reconnect(Math.random);
  #socket: WebSocket | null = null;
  #retry: NodeJS.Timeout | null = null;
  #down = false;
  #closed = false;

  /** Connects at once. */
  constructor(options: MessageLineOptions<In, Out>, events: MessageLineEvents<In>) {
    this.#options = options;
    this.#events = events;
    this.#connect();
  }

  get open(): boolean {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  /** Messages sent while disconnected are dropped: `onOpen` starts over. */
  send(message: Out): void {
    const socket = this.#socket;
    if (socket?.readyState !== WebSocket.OPEN) return;
    if (socket.bufferedAmount > MAX_BACKLOG_BYTES) socket.terminate();
    else socket.send(encodeJson(this.#options.outgoing, message));
  }

  /**
   * Replaces the socket by a new one, on which everything starts over. Does nothing while disconnected, when there is
   * no socket.
   */
  reopen(): void {
    const socket = this.#socket;
    if (this.#closed || socket?.readyState !== WebSocket.OPEN) return;
    this.#socket = null;
    socket.terminate();
    this.#connect();
  }

  close(): void {
    this.#closed = true;
    if (this.#retry !== null) clearTimeout(this.#retry);
    this.#socket?.terminate();
  }

  #connect(): void {
    const { url, ca, incoming } = this.#options;
    let socket: WebSocket;
    try {
      socket = new WebSocket(url, {
        handshakeTimeout: this.#reconnect.timeoutMs,
        maxPayload: incoming.maxBytes,
        perMessageDeflate: false,
        ...(ca == null ? {} : { ca }),
      });
    } catch (error) {
      // An address that no socket accepts, and never will.
      this.#onDown(error instanceof Error ? error.message : String(error));
      return;
    }
    this.#socket = socket;
    let detail = '';
    let heard = true;
    let heartbeat: NodeJS.Timeout | null = null;
    socket.on('open', () => {
      if (this.#closed) return;
      this.#down = false;
      this.#reconnect.reset();
      heartbeat = setInterval(() => {
        if (!heard) socket.terminate();
        heard = false;
        socket.ping();
      }, HEARTBEAT_MS);
      this.#events.onOpen();
    });
    socket.on('pong', () => {
      heard = true;
    });
    socket.on('message', (data: Buffer, binary: boolean) => {
      heard = true;
      if (!this.#closed && socket === this.#socket) this.#receive(binary ? data : data.toString('utf8'));
    });
    socket.on('error', (error) => {
      detail = error.message;
    });
    socket.on('close', () => {
      if (heartbeat !== null) clearInterval(heartbeat);
      if (socket !== this.#socket) return;
      this.#socket = null;
      if (this.#closed) return;
      this.#onDown(detail);
      this.#retry = setTimeout(() => this.#connect(), this.#reconnect.nextMs());
    });
  }

  #onDown(detail: string): void {
    if (this.#down) return;
    this.#down = true;
    this.#events.onDown(detail);
  }

  #receive(data: string | Uint8Array): void {
    let message: In;
    try {
      message = decodeJson(this.#options.incoming, data);
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.malformed++;
      return;
    }
    this.#events.onMessage(message);
  }
}
