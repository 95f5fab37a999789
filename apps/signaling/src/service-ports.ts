/** The service's ports: each with HTTP(S) and WebSockets, and the same limits. */
import type { IncomingMessage, RequestListener } from 'node:http';
import { Listener, type TlsFiles, type UpgradeDecision } from './listener.ts';
import type { SignalingOptions } from './options.ts';
import { strictTransport } from './strict-transport.ts';

/** `null`: not served. */
export interface SignalingPorts {
  readonly signaling: number;
  readonly referenceRobot: number | null;
  readonly referenceClient: number | null;
  readonly lan: number | null;
  readonly lanInstall: number | null;
}

export type PortLimits = Pick<
  SignalingOptions,
  'maxMessageBytes' | 'maxConnections' | 'maxConnectionsPerAddress' | 'trustProxy' | 'shutdownMs'
>;

export interface PortPlace {
  readonly host: string;
  readonly port: number;
  readonly tls: TlsFiles | null;
}

/** Beside an address's WebSockets: requests for the page's files, and WebSockets that are being opened or refused. */
const SPARE_SOCKETS = 64;

export class ServicePorts {
  readonly #limits: PortLimits;
  readonly #onSocketRefused: (address: string) => void;
  readonly #listeners = new Map<keyof SignalingPorts, Listener>();

  constructor(limits: PortLimits, onSocketRefused: (address: string) => void) {
    this.#limits = limits;
    this.#onSocketRefused = onSocketRefused;
  }

  /** @throws {Error} if the address cannot be opened (EADDRINUSE, EACCES …) or the certificate is invalid */
  async open(
    name: keyof SignalingPorts,
    { host, port, tls }: PortPlace,
    http: RequestListener,
    decide: (request: IncomingMessage, url: URL) => UpgradeDecision,
  ): Promise<void> {
    const { maxMessageBytes, maxConnections, maxConnectionsPerAddress, trustProxy, shutdownMs } =
      this.#limits;
    const listener = await Listener.open({
      ...{ host, port, tls },
      // A message slightly above the limit gets an error; one far above it closes the connection.
      maxPayload: 2 * maxMessageBytes,
      maxSockets: maxConnections + 256,
      maxSocketsPerAddress: trustProxy ? null : maxConnectionsPerAddress + SPARE_SOCKETS,
      onSocketRefused: this.#onSocketRefused,
      closeTimeoutMs: shutdownMs,
      http: tls === null ? http : strictTransport(http),
      upgrade: (request) => {
        const url = URL.parse(request.url ?? '', 'http://service');
        return url === null ? { status: 400, reason: 'not a URL' } : decide(request, url);
      },
    });
    this.#listeners.set(name, listener);
  }

  /** Once all are open. */
  get numbers(): SignalingPorts {
    const number = (name: keyof SignalingPorts) => this.#listeners.get(name)?.port ?? null;
    return {
      signaling: number('signaling') as number,
      referenceRobot: number('referenceRobot'),
      referenceClient: number('referenceClient'),
      lan: number('lan'),
      lanInstall: number('lanInstall'),
    };
  }

  /** Sets the certificate of all ports but those of the local network, which have their own. */
  setTls(tls: TlsFiles): void {
    for (const [name, listener] of this.#listeners) if (!name.startsWith('lan')) listener.setTls(tls);
  }

  /** Stops accepting connections; open WebSockets stay. */
  async close(): Promise<void> {
    await Promise.all([...this.#listeners.values()].map((listener) => listener.close()));
  }
}
