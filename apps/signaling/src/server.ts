import { randomBytes } from 'node:crypto';
import type { IncomingMessage, RequestListener } from 'node:http';
import { type Audit, noAudit } from '@farpoint/audit';
import { isLoopbackHost } from '@farpoint/protocol';
import {
  createAdminHandler,
  createMetrics,
  Health,
  type Logger,
  peerAddress,
  type Registry,
  silentLogger,
} from '@farpoint/service';
import { Admission } from './admission.ts';
import { auditObserver } from './audit-observer.ts';
import { systemClock } from './clock.ts';
import { checkExposure } from './exposure.ts';
import { FarpointHub } from './farpoint-hub.ts';
import { httpHandler, notFound } from './http-handler.ts';
import { turnCredentials } from './ice-servers.ts';
import type { Lan } from './lan/lan.ts';
import type { UpgradeDecision } from './listener.ts';
import { LiveSockets } from './live-sockets.ts';
import { createObserver } from './metrics.ts';
import type { Observer, Role } from './observer.ts';
import { defaultOptions, type SignalingOptions } from './options.ts';
import { isOriginAllowed } from './origin-policy.ts';
import type { Connection, Peer } from './peer.ts';
import { ReferenceHub } from './reference-hub.ts';
import { RevocationFiles } from './revocation-files.ts';
import { readFiles, type ServiceFiles } from './service-files.ts';
import { ServicePorts, type SignalingPorts } from './service-ports.ts';

/** What the program provides to the service; tests may omit it. */
export interface SignalingRim {
  readonly log?: Logger;
  readonly health?: Health;
  readonly metrics?: Registry;
  readonly audit?: Audit;
  /** With `--lan`. */
  readonly lan?: Lan;
}

export interface RunningSignaling {
  readonly ports: SignalingPorts;
  /** Reads the certificate and tokens again. @throws {OptionsError} the old ones then stay in force */
  reload(): void;
  /** Tells every peer, waits up to `shutdownMs` for them to hang up, then closes all sockets. */
  close(): Promise<void>;
}

const CANDIDATES_PER_REFERENCE_ROBOT = 128;
const ALL_INTERFACES = '0.0.0.0';
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
  #files: ServiceFiles;
  readonly #lan: Lan | null;
  readonly #ports: ServicePorts;
  #closing: Promise<void> | null = null;

  constructor(options: SignalingOptions, rim: SignalingRim) {
    this.#options = options;
    this.#log = rim.log ?? silentLogger();
    const metrics = rim.metrics ?? createMetrics();
    const health = rim.health ?? new Health();
    this.#lan = rim.lan ?? null;
    this.#files = this.#readFiles();
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
      iceServers: (name) => [
        ...options.iceServers,
        ...(options.turnSecret === null || options.turnUrls.length === 0
          ? []
          : [
              turnCredentials(
                { urls: options.turnUrls, secret: options.turnSecret, ttlSeconds: options.turnTtlSeconds },
                name,
                Date.now() / 1000,
              ),
            ]),
      ],
      revocations: () => this.#revocations.lists,
      makeHandle: () => randomBytes(16).toString('base64url'),
      signInUrl: ({ address }) => options.signInUrl ?? this.#lan?.pairingUrl(isLoopbackHost(address)) ?? null,
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
    this.#ports = new ServicePorts(options, (address) =>
      this.#observer.rejected('operator', 'too-many-sockets', address),
    );
    const { heartbeatMs, maxBacklogBytes } = options;
    this.#sockets = new LiveSockets({
      heartbeatMs,
      maxBacklogBytes,
      admission: this.#admission,
      observer: this.#observer,
    });
    health.add('connections', () => {
      const { connections, robots, referenceRobots, sessions } = this.#counts();
      const ok = this.#admission.total < options.maxConnections;
      return { ok, detail: { ...connections, robots, referenceRobots, sessions } };
    });
    const http = httpHandler(createAdminHandler(health, metrics), options);
    this.#http = this.#lan?.withPairing(http) ?? http;
  }

  get ports(): SignalingPorts {
    return this.#ports.numbers;
  }

  async open(): Promise<void> {
    const { host, port, reference, referenceRobotPort, referenceClientPort, lanPort, lanInstallPort } =
      this.#options;
    const lan = this.#lan;
    // First: a robot that registers gets them with its welcome.
    await this.#revocations.start();
    const { tls } = this.#files;
    const isLocal = isLoopbackHost(host) && !this.#options.trustProxy;
    try {
      const own = { host, tls };
      await this.#ports.open('signaling', { ...own, port }, this.#http, (request, url) =>
        this.#upgrade(request, url, isLocal),
      );
      if (reference) {
        await this.#ports.open(
          'referenceRobot',
          { ...own, port: referenceRobotPort },
          notFound,
          (request, url) => this.#upgradeReference(request, url, 'reference-robot', isLocal),
        );
        await this.#ports.open(
          'referenceClient',
          { ...own, port: referenceClientPort },
          notFound,
          (request, url) => this.#upgradeReference(request, url, 'reference-client', isLocal),
        );
      }
      if (lan !== null) {
        const all = { host: ALL_INTERFACES };
        await this.#ports.open('lan', { ...all, port: lanPort, tls: lan.tls }, this.#http, (request, url) =>
          this.#upgrade(request, url, false),
        );
        await this.#ports.open(
          'lanInstall',
          { ...all, port: lanInstallPort, tls: null },
          lan.install,
          () => ({
            status: 404,
            reason: 'no WebSockets here',
          }),
        );
      }
    } catch (error) {
      await this.close();
      throw error;
    }
    this.#log.info({ host, ...this.ports, tls: tls !== null }, 'listening');
  }

  reload(): void {
    this.#files = this.#readFiles();
    if (this.#files.tls !== null) this.#ports.setTls(this.#files.tls);
    this.#audit.record({ kind: 'reloaded', details: { what: 'certificate and tokens' } });
    this.#log.info('reloaded certificate and tokens');
  }

  close(): Promise<void> {
    this.#closing ??= this.#close();
    return this.#closing;
  }

  async #close(): Promise<void> {
    const listening = this.#ports.close();
    this.#farpoint.stop();
    this.#revocations.close();
    await this.#sockets.shutDown(this.#options.shutdownMs);
    await listening;
  }

  #readFiles(): ServiceFiles {
    const files = readFiles(this.#options);
    checkExposure(this.#options, files);
    if (this.#lan !== null)
      checkExposure({ ...this.#options, host: ALL_INTERFACES }, { ...files, tls: this.#lan.tls });
    return files;
  }

  #upgrade(request: IncomingMessage, url: URL, isLocal: boolean): UpgradeDecision {
    switch (url.pathname) {
      case '/robot':
        return this.#admit(request, 'robot', isLocal, (peer) => this.#farpoint.robot(peer));
      case '/operator':
        return this.#admit(request, 'operator', isLocal, (peer) => this.#farpoint.operator(peer));
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
    isLocal: boolean,
  ): UpgradeDecision {
    const access = role === 'reference-robot' ? this.#files.robots : this.#files.operators;
    if (!this.#options.referenceOpen && !access.allows(url.searchParams.get('token') ?? undefined, null)) {
      this.#observer.rejected(role, 'unauthorized', '');
      return { status: 401, reason: 'needs ?token= in the URL' };
    }
    return this.#admit(request, role, isLocal, (peer) =>
      role === 'reference-robot' ? this.#reference.robot(peer) : this.#reference.client(peer),
    );
  }

  /** @param isLocal whether only this machine reaches the port */
  #admit(
    request: IncomingMessage,
    role: Role,
    isLocal: boolean,
    connect: (peer: Peer) => Connection,
  ): UpgradeDecision {
    const { allowedOrigins: allowed, trustProxy } = this.#options;
    if (this.#closing !== null) return { status: 503, reason: 'shutting down' };
    const { origin = '', host: name } = request.headers;
    if (!isOriginAllowed(request.headers.origin, name, { allowed, isLocal })) {
      this.#observer.rejected(role, 'origin', origin.slice(0, 100));
      return { status: 403, reason: 'not from this origin: see --allowed-origins' };
    }
    const address = peerAddress(request, trustProxy);
    const refusal = this.#admission.refusal(address);
    if (refusal !== null) {
      this.#observer.rejected(role, refusal, address);
      return refusal === 'too-many-connections'
        ? { status: 503, reason: 'no room for another connection' }
        : { status: 429, reason: 'too many connections from this address' };
    }
    return { accept: (socket) => this.#sockets.accept(socket, role, address, connect) };
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
