/** The bridge's line to the reference protocol's client port: comes back for ever, asks for the robots each time. */
import { Reconnect } from '@farpoint/congestion';
import {
  decodeJson,
  encodeJson,
  ProtocolError,
  type ReferenceClientToService,
  type ReferenceServiceToClient,
  referenceClientToServiceCodec,
  referenceServiceToClientCodec,
} from '@farpoint/protocol';
import { WebSocket } from 'ws';

const MAX_BACKLOG_BYTES = 1_048_576;

export interface SignalingLineEvents {
  onMessage: (message: ReferenceServiceToClient) => void;
  onDown: (detail: string) => void;
}

export class SignalingLine {
  /** Messages that could not be read. */
  malformed = 0;
  readonly #url: string;
  readonly #events: SignalingLineEvents;
  readonly #reconnect = new Reconnect(Math.random);
  #socket: WebSocket | null = null;
  #retry: NodeJS.Timeout | null = null;
  #closed = false;

  constructor(url: string, events: SignalingLineEvents) {
    this.#url = url;
    this.#events = events;
    this.#connect();
  }

  get open(): boolean {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  /** What is sent while the line is down is dropped: the list of robots that follows begins anew. */
  send(message: ReferenceClientToService): void {
    const socket = this.#socket;
    if (socket?.readyState !== WebSocket.OPEN) return;
    if (socket.bufferedAmount > MAX_BACKLOG_BYTES) socket.terminate();
    else socket.send(encodeJson(referenceClientToServiceCodec, message));
  }

  close(): void {
    this.#closed = true;
    if (this.#retry !== null) clearTimeout(this.#retry);
    this.#socket?.terminate();
  }

  #connect(): void {
    const socket = new WebSocket(this.#url, {
      handshakeTimeout: this.#reconnect.timeoutMs,
      maxPayload: referenceServiceToClientCodec.maxBytes,
      perMessageDeflate: false,
    });
    this.#socket = socket;
    let detail = '';
    socket.on('open', () => {
      this.#reconnect.reset();
      this.send({ type: 'getRobots' });
    });
    socket.on('message', (data: Buffer, binary: boolean) => {
      if (!this.#closed) this.#receive(binary ? data : data.toString('utf8'));
    });
    socket.on('error', (error) => {
      detail = error.message;
    });
    socket.on('close', () => {
      this.#socket = null;
      if (this.#closed) return;
      this.#events.onDown(detail);
      this.#retry = setTimeout(() => this.#connect(), this.#reconnect.nextMs());
    });
  }

  #receive(data: string | Uint8Array): void {
    let message: ReferenceServiceToClient;
    try {
      message = decodeJson(referenceServiceToClientCodec, data);
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.malformed++;
      return;
    }
    this.#events.onMessage(message);
  }
}
