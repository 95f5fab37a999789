import type { RemoteInfo } from 'node:dgram';
import { isIP } from 'node:net';
import { networkInterfaces } from 'node:os';
import { type CrossFlow, type LinkBin, LinkModel, type LinkProfile } from '@farpoint/network-sim';
import type { Endpoint } from './candidate.ts';
import { ForwardPort } from './forward-port.ts';
import { LatenessHistogram } from './lateness.ts';
import type { Side } from './signaling-messages.ts';

/** From the robot (`up`), and to it (`down`). */
export const directions = ['up', 'down'] as const;
export type Direction = (typeof directions)[number];

export interface DirectionOptions {
  readonly profile: LinkProfile;
  /** Created for the instant at which the link opens. */
  readonly crossFlows?: (startMs: number) => readonly CrossFlow[];
}

export interface UdpLinkOptions {
  readonly up: DirectionOptions;
  readonly down: DirectionOptions;
  readonly seed: number;
  /** The address of stand-ins for peers on other machines; peers on this machine keep theirs. Default 127.0.0.1. */
  readonly host?: string;
  readonly onBin?: (direction: Direction, bin: LinkBin) => void;
  /** A stand-in that is unused for this long is closed. */
  readonly idleMs?: number;
  /** Maximum number of stand-ins; the one unused for longest makes room for a new one. */
  readonly maxPorts?: number;
}

/** How often idle stand-ins are looked for, ms. Chosen: a twelfth of the minute for which one may be idle. */
const SWEEP_MS = 5000;
/** Longest interval between two updates of the models, so that their statistics are on time. */
const LONGEST_SLEEP_MS = 50;

/** CLOCK_MONOTONIC, as in `process.hrtime`, in milliseconds: the same for all processes of a machine. */
export function monotonicMs(): number {
  return performance.now() + CLOCK_OFFSET_MS;
}
const CLOCK_OFFSET_MS = Number(process.hrtime.bigint()) / 1e6 - performance.now();

/** Length of the UDP and IP headers of a datagram. */
export function headerBytes(address: string): number {
  return address.includes(':') ? 48 : 28;
}

/**
 * The link between peers as sockets: each endpoint of a peer has a stand-in, and the peers only ever see stand-ins. A
 * packet sent to a stand-in enters the model of its direction and leaves from the sender's own stand-in.
 */
export class UdpLink {
  readonly models: Readonly<Record<Direction, LinkModel>>;
  /** How much later than the model's times packets were sent. */
  readonly lateness = new LatenessHistogram();
  /** When the capacities began. */
  readonly startMs: number;
  readonly #options: Required<Pick<UdpLinkOptions, 'host' | 'idleMs' | 'maxPorts'>>;
  readonly #ports: Record<Side, Map<string, ForwardPort>> = { robot: new Map(), operator: new Map() };
  /** Packets in flight, by handle. */
  readonly #data: (Buffer | null)[] = [];
  readonly #from: (ForwardPort | null)[] = [];
  readonly #to: (ForwardPort | null)[] = [];
  readonly #copies: number[] = [];
  readonly #free: number[] = [];
  readonly #sweeper: NodeJS.Timeout;
  #timer: NodeJS.Timeout | null = null;
  #timerMs = Number.POSITIVE_INFINITY;
  #nowMs: number;
  #closed = false;
  packets = 0;

  constructor(options: UdpLinkOptions) {
    const { seed, onBin, host = '127.0.0.1', idleMs = 60_000, maxPorts = 128 } = options;
    this.#options = { host, idleMs, maxPorts };
    this.startMs = monotonicMs();
    this.#nowMs = this.startMs;
    const sink = {
      delivered: (handle: number, atMs: number) => this.#send(handle, atMs),
      duplicated: (handle: number) => {
        this.#copies[handle]!++;
      },
    };
    const model = (direction: Direction, seedOf: number) =>
      new LinkModel({
        profile: options[direction].profile,
        seed: seedOf,
        startMs: this.startMs,
        sink,
        crossFlows: options[direction].crossFlows?.(this.startMs) ?? [],
        onBin: (bin) => onBin?.(direction, bin),
      });
    this.models = { up: model('up', 2 * seed), down: model('down', 2 * seed + 1) };
    this.#sweeper = setInterval(() => this.#sweep(), SWEEP_MS).unref();
    this.#arm();
  }

  /** Number of open stand-ins. */
  get ports(): number {
    return this.#ports.robot.size + this.#ports.operator.size;
  }

  /**
   * Opens the stand-in for a peer's endpoint, or finds the existing one.
   *
   * @returns the stand-in's endpoint, to tell the other peer
   * @throws {Error} if no socket can be bound
   */
  async standInFor(side: Side, real: Endpoint): Promise<Endpoint> {
    if (this.isStandIn(real)) return real;
    const port = this.#find(side, real) ?? this.#open(side, real, this.#bindAddress(real));
    port.usedMs = monotonicMs();
    await port.ready;
    return port.own!;
  }

  /** The open stand-in for a peer's endpoint, if there is one. */
  standIn(side: Side, real: Endpoint): Endpoint | null {
    if (this.isStandIn(real)) return real;
    return this.#find(side, real)?.own ?? null;
  }

  /** Whether the endpoint is already one of ours. */
  isStandIn(endpoint: Endpoint): boolean {
    for (const ports of Object.values(this.#ports)) {
      for (const { own } of ports.values()) {
        if (own !== null && own.port === endpoint.port && own.address === endpoint.address) return true;
      }
    }
    return false;
  }

  /** Advances the models, and sends what is due; call after changing one of them. */
  advance(): void {
    if (this.#closed) return;
    this.#nowMs = monotonicMs();
    this.models.up.advance(this.#nowMs);
    this.models.down.advance(this.#nowMs);
    this.#arm();
  }

  close(): void {
    this.#closed = true;
    clearInterval(this.#sweeper);
    if (this.#timer !== null) clearTimeout(this.#timer);
    for (const ports of Object.values(this.#ports)) for (const port of ports.values()) port.close();
  }

  #find(side: Side, { address, port }: Endpoint): ForwardPort | undefined {
    return this.#ports[side].get(`${address} ${port}`);
  }

  #open(side: Side, real: Endpoint, bindAddress: string): ForwardPort {
    if (this.ports >= this.#options.maxPorts) this.#evict();
    const port = new ForwardPort(side, real, bindAddress, monotonicMs(), this.#onPacket);
    this.#ports[side].set(`${real.address} ${real.port}`, port);
    return port;
  }

  /** On this machine, the peer's own address, so that each side answers from the address it is contacted at. */
  #bindAddress({ address }: Endpoint): string {
    for (const addresses of Object.values(networkInterfaces())) {
      if (addresses?.some((own) => own.address === address)) return address;
    }
    const { host } = this.#options;
    return isIP(host) === isIP(address) ? host : isIP(address) === 6 ? '::1' : '127.0.0.1';
  }

  readonly #onPacket = (to: ForwardPort, data: Buffer, source: RemoteInfo): void => {
    const nowMs = monotonicMs();
    this.#nowMs = nowMs;
    this.packets++;
    to.usedMs = nowMs;
    const from = this.#sender(to, source);
    from.usedMs = nowMs;
    const handle = this.#free.pop() ?? this.#data.push(null) - 1;
    this.#data[handle] = data;
    this.#from[handle] = from;
    this.#to[handle] = to;
    this.#copies[handle] = 1;
    const model = to.side === 'operator' ? this.models.up : this.models.down;
    if (model.offer(data.length + headerBytes(source.address), nowMs, handle) !== null) this.#release(handle);
    this.#arm();
  };

  /** The stand-in of whoever sent a packet to `to`; one is created for an endpoint that signaling did not name. */
  #sender(to: ForwardPort, source: RemoteInfo): ForwardPort {
    const last = to.lastFrom;
    if (
      last !== null &&
      !last.closed &&
      last.real.port === source.port &&
      last.real.address === source.address
    ) {
      return last;
    }
    const side = to.side === 'robot' ? 'operator' : 'robot';
    const real = { address: source.address, port: source.port };
    // The receiver sees it arrive from an address that it can answer.
    const from = this.#find(side, real) ?? this.#open(side, real, to.own!.address);
    to.lastFrom = from;
    return from;
  }

  #send(handle: number, atMs: number): void {
    this.lateness.add(this.#nowMs - atMs);
    this.#from[handle]!.send(this.#data[handle]!, this.#to[handle]!.real);
    if (--this.#copies[handle]! === 0) this.#release(handle);
  }

  #release(handle: number): void {
    this.#data[handle] = this.#from[handle] = this.#to[handle] = null;
    this.#free.push(handle);
  }

  #arm(): void {
    if (this.#closed) return;
    const wakeMs = Math.min(this.models.up.wakeMs, this.models.down.wakeMs, this.#nowMs + LONGEST_SLEEP_MS);
    if (this.#timer !== null) {
      if (this.#timerMs <= wakeMs) return;
      clearTimeout(this.#timer);
    }
    this.#timerMs = wakeMs;
    this.#timer = setTimeout(this.#onTimer, Math.max(1, Math.ceil(wakeMs - this.#nowMs)));
  }

  readonly #onTimer = (): void => {
    this.#timer = null;
    this.advance();
  };

  #sweep(): void {
    const before = monotonicMs() - this.#options.idleMs;
    for (const ports of Object.values(this.#ports)) {
      for (const [key, port] of ports) {
        if (port.usedMs >= before && !port.closed) continue;
        port.close();
        ports.delete(key);
      }
    }
  }

  #evict(): void {
    let oldest: { ports: Map<string, ForwardPort>; key: string; port: ForwardPort } | null = null;
    for (const ports of Object.values(this.#ports)) {
      for (const [key, port] of ports) {
        if (oldest === null || port.usedMs < oldest.port.usedMs) oldest = { ports, key, port };
      }
    }
    if (oldest === null) return;
    oldest.port.close();
    oldest.ports.delete(oldest.key);
  }
}
