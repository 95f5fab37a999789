import type { IncomingMessage } from 'node:http';
import type { AddressInfo } from 'node:net';
import { type RawData, WebSocket, WebSocketServer } from 'ws';
import {
  type CandidateFault,
  type Endpoint,
  endpointsOf,
  readCandidate,
  rewriteSdp,
  standIn,
} from './candidate.ts';
import { type CandidateMapper, mapMessage, type Side } from './signaling-messages.ts';
import type { UdpLink } from './udp-link.ts';

export interface InterposerOptions {
  readonly link: UdpLink;
  /** The signaling service, ws:// or wss://. */
  readonly upstream: string;
  readonly host: string;
  /** 0 chooses a free port. */
  readonly port: number;
  /**
   * Who connects to this port: one kind of peer of the reference system's signaling, or both kinds of Farpoint's,
   * distinguished by `/robot` and `/operator`.
   */
  readonly peers: 'farpoint' | 'reference-robots' | 'reference-clients';
  readonly events?: InterposerEvents;
}

export interface InterposerEvents {
  onPeer?(side: Side, path: string): void;
  /** A candidate was left out because it cannot be routed through the link. */
  onFault?(side: Side, fault: CandidateFault): void;
  onError?(error: Error): void;
}

/** As large as the largest message of either protocol. */
const MAX_PAYLOAD_BYTES = 8_388_608;
/** A peer that sends more messages than this while candidates are being placed is disconnected. */
const MAX_PENDING = 1000;
/** Close codes that only mean that no code was given. */
const SILENT_CODES = new Set([1005, 1006, 1015]);

/**
 * Sits in front of a signaling service and routes every candidate that passes through the link. It is enough if one
 * peer of a session connects through it: it sees both what that peer sends and what it receives.
 */
export class SignalingInterposer {
  readonly #options: InterposerOptions;
  readonly #server: WebSocketServer;

  private constructor(options: InterposerOptions, server: WebSocketServer) {
    this.#options = options;
    this.#server = server;
    server.on('connection', (socket, request) => this.#connect(socket, request));
    server.on('error', (error) => options.events?.onError?.(error));
  }

  /** @throws {Error} if it cannot listen on the port */
  static async open(options: InterposerOptions): Promise<SignalingInterposer> {
    const { host, port } = options;
    const server = new WebSocketServer({
      host,
      port,
      maxPayload: MAX_PAYLOAD_BYTES,
      perMessageDeflate: false,
    });
    await new Promise<void>((resolve, reject) => {
      server.once('listening', resolve);
      server.once('error', reject);
    });
    return new SignalingInterposer(options, server);
  }

  get port(): number {
    return (this.#server.address() as AddressInfo).port;
  }

  get connections(): number {
    return this.#server.clients.size;
  }

  close(): Promise<void> {
    for (const client of this.#server.clients) client.terminate();
    return new Promise((resolve) => {
      this.#server.close(() => resolve());
    });
  }

  #connect(peer: WebSocket, request: IncomingMessage): void {
    const { upstream, events } = this.#options;
    const path = request.url ?? '/';
    const side = this.#sideOf(path);
    const { origin } = request.headers;
    const service = new WebSocket(serviceUrl(upstream, path), {
      perMessageDeflate: false,
      maxPayload: MAX_PAYLOAD_BYTES,
      ...(origin === undefined ? {} : { origin }),
    });
    if (side !== null) events?.onPeer?.(side, path);
    const other = side === null ? null : side === 'robot' ? 'operator' : 'robot';
    const opened = new Promise<void>((resolve) => {
      service.once('open', resolve);
      service.once('close', resolve);
    });
    this.#pipe(peer, service, side, opened);
    this.#pipe(service, peer, other, Promise.resolve());
    peer.on('error', (error) => events?.onError?.(error));
    service.on('error', (error) => events?.onError?.(error));
  }

  #sideOf(path: string): Side | null {
    const { peers } = this.#options;
    if (peers !== 'farpoint') return peers === 'reference-robots' ? 'robot' : 'operator';
    const { pathname } = new URL(path, 'ws://peer.invalid');
    // The service may be below a path.
    return pathname.endsWith('/robot') ? 'robot' : pathname.endsWith('/operator') ? 'operator' : null;
  }

  /** Keeps messages in order although placing candidates takes time; then forwards the close. */
  #pipe(source: WebSocket, target: WebSocket, from: Side | null, ready: Promise<void>): void {
    let pending = 0;
    let chain = ready;
    source.on('message', (data, binary) => {
      if (++pending > MAX_PENDING) {
        source.terminate();
        return;
      }
      chain = chain
        .then(() => this.#relay(data, binary, from, target))
        .catch((error: Error) => this.#options.events?.onError?.(error))
        .finally(() => {
          pending--;
        });
    });
    source.on('close', (code, reason) => {
      void chain.then(() => {
        // If the service never answered, the peer sees a connection that nobody accepted.
        if (SILENT_CODES.has(code) || target.readyState === WebSocket.CONNECTING) target.terminate();
        else target.close(code, reason);
      });
    });
  }

  async #relay(data: RawData, binary: boolean, from: Side | null, target: WebSocket): Promise<void> {
    let text = data.toString();
    if (from !== null) {
      await this.#place(text, from);
      const rewritten = mapMessage(text, from, this.#rewriting);
      if (rewritten === null) return;
      text = rewritten;
    }
    if (target.readyState !== WebSocket.OPEN) return;
    if (from === null) target.send(data, { binary });
    else target.send(binary ? Buffer.from(text) : text, { binary });
  }

  /** Opens a stand-in for every endpoint that a message names. */
  async #place(text: string, from: Side): Promise<void> {
    const named: { side: Side; endpoint: Endpoint }[] = [];
    mapMessage(text, from, {
      sdp: (side, sdp) => {
        for (const endpoint of endpointsOf(sdp)) named.push({ side, endpoint });
        return sdp;
      },
      candidate: (side, line) => {
        const candidate = readCandidate(line);
        if (typeof candidate !== 'string') named.push({ side, endpoint: candidate.endpoint });
        return line;
      },
    });
    for (const { side, endpoint } of named) {
      try {
        await this.#options.link.standInFor(side, endpoint);
      } catch (error) {
        // Without a stand-in, the candidate is left out below.
        this.#options.events?.onError?.(error as Error);
      }
    }
  }

  readonly #rewriting: CandidateMapper = {
    sdp: (side, sdp) =>
      rewriteSdp(
        sdp,
        (endpoint) => this.#options.link.standIn(side, endpoint),
        (fault) => this.#options.events?.onFault?.(side, fault),
      ),
    candidate: (side, line) => {
      const candidate = readCandidate(line);
      if (typeof candidate === 'string') {
        this.#options.events?.onFault?.(side, candidate);
        return null;
      }
      const endpoint = this.#options.link.standIn(side, candidate.endpoint);
      return endpoint === null ? null : standIn(candidate, endpoint);
    },
  };
}

/** The service's address, extended by the path that the peer requested. */
function serviceUrl(upstream: string, path: string): URL {
  const base = new URL(upstream);
  const asked = new URL(path, 'ws://peer.invalid');
  base.pathname = `${base.pathname.replace(/\/$/, '')}${asked.pathname}`;
  base.search = asked.search;
  return base;
}
