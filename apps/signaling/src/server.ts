import { randomBytes } from 'node:crypto';
import type { IncomingMessage, RequestListener } from 'node:http';
import { type Audit, noAudit } from '@farpoint/audit';
import { isLoopbackHost } from '@farpoint/protocol';
import {
  createAdminHandler,
  createMetrics,
  Health,
  hostRefusal,
  type Logger,
  ownNames,
  peerAddress,
  type Registry,
  silentLogger,
  TrustedProxies,
} from '@farpoint/service';
import { Admission } from './admission.ts';
import { auditObserver } from './audit-observer.ts';
import { systemClock } from './clock.ts';
import { checkExposure } from './exposure.ts';
import { FarpointHub } from './farpoint-hub.ts';
import { forOwnNames, httpHandler, notFound } from './http-handler.ts';
import { iceServersFor } from './ice-servers.ts';
import { Listener, type UpgradeDecision } from './listener.ts';
import { LiveSockets } from './live-sockets.ts';
import { createObserver } from './metrics.ts';
import type { Observer, Role } from './observer.ts';
import { defaultOptions, type SignalingOptions } from './options.ts';
import { judgeOrigin } from './origin-policy.ts';
import type { Connection, Peer } from './peer.ts';
import { ReferenceHub } from './reference-hub.ts';
import { RevocationFiles } from './revocation-files.ts';
import { readFiles, type ServiceFiles } from './service-files.ts';
import { strictTransport } from './strict-transport.ts';

/** What the program provides to the service; tests may omit it. */
export interface SignalingRim {
  readonly log?: Logger;
  readonly health?: Health;
  readonly metrics?: Registry;
  readonly audit?: Audit;
}

export interface SignalingPorts {
  readonly signaling: number;
  readonly referenceRobot: number | null;
  readonly referenceClient: number | null;
}

export interface RunningSignaling {
  readonly ports: SignalingPorts;
  /** Reads the certificate and tokens again. @throws {OptionsError} the old ones then stay in force */
  reload(): void;
  /** Tells every peer, waits up to `shutdownMs` for them to hang up, then closes all sockets. */
  close(): Promise<void>;
}

/** ICE candidates that are kept for those who connect later. Chosen: several times what a host with many addresses has. */
const CANDIDATES_PER_REFERENCE_ROBOT = 128;
/** Beside an address's WebSockets: requests for the page's files, and WebSockets that are being opened or refused. */
const SPARE_SOCKETS = 64;

/**
 * Starts the service.
 *
 * @param given options that differ from their defaults
 * @throws {OptionsError} for missing or invalid files; {Error} if a port cannot be opened
 */
export async function startSignaling(
  given: Partial<SignalingOptions> = {},
  rim: SignalingRim = {},
): Promise<RunningSignaling> {
  const service = new SignalingService({ ...defaultOptions(), ...given }, rim);
  await service.open();
  return service;
}

class SignalingService implements RunningSignaling {
  readonly #options: SignalingOptions;
  readonly #log: Logger;
  readonly #http: RequestListener;
  readonly #farpoint: FarpointHub;
  readonly #reference: ReferenceHub;
  readonly #admission: Admission;
  readonly #sockets: LiveSockets;
  readonly #revocations: RevocationFiles;
  readonly #observer: Observer;
  readonly #audit: Audit;
  readonly #ownNames: ReadonlySet<string>;
  readonly #proxies: TrustedProxies;
  #files: ServiceFiles;
  #listeners: Listener[] = [];
  #closing: Promise<void> | null = null;

  constructor(options: SignalingOptions, rim: SignalingRim) {
    this.#options = options;
    this.#ownNames = ownNames(options.publicNames);
    this.#proxies = new TrustedProxies(options.trustProxy);
    this.#log = rim.log ?? silentLogger();
    const metrics = rim.metrics ?? createMetrics();
    const health = rim.health ?? new Health();
    this.#files = readFiles(options);
    checkExposure(options, this.#files);
    this.#audit = rim.audit ?? noAudit;
    const observer = createObserver(this.#log, metrics, () => this.#counts());
    this.#observer = this.#audit === noAudit ? observer : auditObserver(this.#audit, observer);
    const core = { clock: systemClock, observer: this.#observer };
    this.#farpoint = new FarpointHub({
      ...core,
      limits: options,
      listIntervalMs: options.listIntervalMs,
      listBytesPerSecond: options.listBytesPerSecond,
      access: () => this.#files,
      iceServers: (name) => iceServersFor(name, options),
      revocations: () => this.#revocations.lists,
      makeHandle: () => randomBytes(16).toString('base64url'),
      signInUrl: options.signInUrl,
    });
    this.#revocations = new RevocationFiles({
      paths: options.revocations,
      log: this.#log,
      onChange: (list) => this.#farpoint.tellRevocations(list),
    });
    this.#reference = new ReferenceHub({
      ...core,
      limits: { ...options, maxCandidatesPerRobot: CANDIDATES_PER_REFERENCE_ROBOT },
    });
    this.#admission = new Admission(options);
    const { heartbeatMs, maxBacklogBytes } = options;
    this.#sockets = new LiveSockets({
      heartbeatMs,
      maxBacklogBytes,
      admission: this.#admission,
      observer: this.#observer,
    });
    health.add('connections', () => this.#connectionsHealth());
    this.#http = httpHandler(createAdminHandler(health, metrics), options);
  }

  get ports(): SignalingPorts {
    const [signaling, robot, client] = this.#listeners;
    return {
      signaling: signaling!.port,
      referenceRobot: robot?.port ?? null,
      referenceClient: client?.port ?? null,
    };
  }

  async open(): Promise<void> {
    const { port, reference, referenceRobotPort, referenceClientPort } = this.#options;
    // First: a robot that registers gets them with its welcome.
    await this.#revocations.start();
    try {
      await this.#listen(port, this.#http, (request, url) => this.#upgrade(request, url));
      if (reference) {
        await this.#listen(referenceRobotPort, notFound, (request, url) =>
          this.#upgradeReference(request, url, 'reference-robot'),
        );
        await this.#listen(referenceClientPort, notFound, (request, url) =>
          this.#upgradeReference(request, url, 'reference-client'),
        );
      }
    } catch (error) {
      await this.close();
      throw error;
    }
    this.#log.info({ host: this.#options.host, ...this.ports, tls: this.#files.tls !== null }, 'listening');
  }

  reload(): void {
    const files = readFiles(this.#options);
    checkExposure(this.#options, files);
    this.#files = files;
    for (const listener of this.#listeners) if (this.#files.tls !== null) listener.setTls(this.#files.tls);
    this.#audit.record({ kind: 'reloaded', details: { what: 'certificate and tokens' } });
    this.#log.info('reloaded certificate and tokens');
  }

  close(): Promise<void> {
    this.#closing ??= this.#close();
    return this.#closing;
  }

  async #close(): Promise<void> {
    const listening = Promise.all(this.#listeners.map((listener) => listener.close()));
    this.#farpoint.stop();
    this.#revocations.close();
    await this.#sockets.shutDown(this.#options.shutdownMs);
    await listening;
  }

  async #listen(
    port: number,
    http: RequestListener,
    decide: (request: IncomingMessage, url: URL) => UpgradeDecision,
  ): Promise<void> {
    const { host, maxMessageBytes, maxConnections, maxConnectionsPerAddress, shutdownMs } = this.#options;
    this.#listeners.push(
      await Listener.open({
        host,
        port,
        tls: this.#files.tls,
        // A message slightly above the limit gets an error; one far above it closes the connection.
        maxPayload: 2 * maxMessageBytes,
        maxSockets: maxConnections + 256,
        maxSocketsPerAddress: maxConnectionsPerAddress + SPARE_SOCKETS,
        isProxy: (address) => this.#proxies.has(address),
        onSocketRefused: (address) => this.#observer.rejected('operator', 'too-many-sockets', address),
        closeTimeoutMs: shutdownMs,
        http: this.#files.tls === null ? forOwnNames(http, this.#ownNames) : strictTransport(http),
        upgrade: (request) => {
          const url = URL.parse(request.url ?? '', 'http://service');
          return url === null ? { status: 400, reason: 'not a URL' } : decide(request, url);
        },
      }),
    );
  }

  #upgrade(request: IncomingMessage, url: URL): UpgradeDecision {
    switch (url.pathname) {
      case '/robot':
        return this.#admit(request, 'robot', (peer) => this.#farpoint.robot(peer));
      case '/operator':
        return this.#admit(request, 'operator', (peer) => this.#farpoint.operator(peer));
      default:
        this.#observer.rejected('operator', 'unknown-path', url.pathname.slice(0, 100));
        return { status: 404, reason: 'WebSockets are at /robot and /operator' };
    }
  }

  /** Accepts any path. The reference protocol has no tokens: if tokens are configured, one must be in the URL. */
  #upgradeReference(
    request: IncomingMessage,
    url: URL,
    role: 'reference-robot' | 'reference-client',
  ): UpgradeDecision {
    const access = role === 'reference-robot' ? this.#files.robots : this.#files.operators;
    if (!this.#options.referenceOpen && !access.allows(url.searchParams.get('token') ?? undefined, null)) {
      this.#observer.rejected(role, 'unauthorized', '');
      return { status: 401, reason: 'needs ?token= in the URL' };
    }
    return this.#admit(request, role, (peer) =>
      role === 'reference-robot' ? this.#reference.robot(peer) : this.#reference.client(peer),
    );
  }

  #admit(request: IncomingMessage, role: Role, connect: (peer: Peer) => Connection): UpgradeDecision {
    const { allowedOrigins: allowed, trustProxy, host } = this.#options;
    if (this.#closing !== null) return { status: 503, reason: 'shutting down' };
    const { origin = '', host: name } = request.headers;
    const isLocal = isLoopbackHost(host) && trustProxy.length === 0;
    const policy = { allowed, isLocal, ownNames: this.#files.tls === null ? this.#ownNames : null };
    const verdict = judgeOrigin(request.headers.origin, name, policy);
    if (verdict !== 'allowed') {
      this.#observer.rejected(role, verdict, origin.slice(0, 100));
      return verdict === 'host'
        ? { status: 421, reason: hostRefusal(name, '--public-names') }
        : { status: 403, reason: 'not from this origin: see --allowed-origins' };
    }
    const address = peerAddress(request, this.#proxies);
    const refusal = this.#admission.refusal(address);
    if (refusal !== null) {
      this.#observer.rejected(role, refusal, address);
      return refusal === 'too-many-connections'
        ? { status: 503, reason: 'no room for another connection' }
        : { status: 429, reason: 'too many connections from this address' };
    }
    return { accept: (socket) => this.#sockets.accept(socket, role, address, connect) };
  }

  #connectionsHealth() {
    const { connections, robots, referenceRobots, sessions } = this.#counts();
    const ok = this.#admission.total < this.#options.maxConnections;
    return { ok, detail: { ...connections, robots, referenceRobots, sessions } };
  }

  #counts() {
    const farpoint = this.#farpoint.counts;
    return {
      connections: this.#sockets.byRole,
      robots: farpoint.robots,
      sessions: farpoint.sessions,
      referenceRobots: this.#reference.counts.robots,
    };
  }
}
