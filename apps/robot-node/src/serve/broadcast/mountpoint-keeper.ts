import { createHmac, randomBytes } from 'node:crypto';
import { lookup } from 'node:dns/promises';
import { setTimeout as delay } from 'node:timers/promises';
import { JanusFailure, type MountpointMedia, StreamingClient } from '@farpoint/janus';
import { SRTP_CM_MASTER_BYTES } from '@farpoint/rtp/srtp';
import type { Logger } from '@farpoint/service';
import { Backoff } from '@farpoint/timing';
import WebSocket from 'ws';
import { type BroadcastOptions, isLoopback } from './broadcast-options.ts';
import type { StreamPorts } from './broadcast-sockets.ts';

/** A mountpoint that Janus has made for us. */
export interface Mountpoint {
  /** Where Janus takes the packets: an IP address. */
  address: string;
  /** By m-line, in the order of {@link MountpointKeeperParts.media}. */
  ports: readonly StreamPorts[];
  /** SRTP master key and salt; `null` for packets in clear. */
  srtp: Uint8Array | null;
}

export interface MountpointKeeperParts {
  options: BroadcastOptions;
  /** The robot's name, for people. */
  name: string;
  media: readonly MountpointMedia[];
  /** What viewers are told; read whenever {@link MountpointKeeper.describe} was called. */
  metadata: () => string;
  log: Pick<Logger, 'info' | 'warn' | 'debug'>;
}

export interface MountpointKeeperEvents {
  /** Janus takes packets from now on; an earlier mountpoint is gone. */
  onMountpoint(mountpoint: Mountpoint): void;
  /** Janus was out of reach for a while, and the mountpoint is still there. */
  onFoundAgain(): void;
  /** How many watch, several times a minute at least. */
  onViewers(viewers: number): void;
}

/**
 * How often Janus is asked who watches, ms. Chosen: the first viewer waits for it, and an answer is a few
 * hundred bytes.
 */
const POLL_MS = 1000;
/**
 * Delay of the first attempt after a failed one, and the longest, ms: it doubles. Chosen: viewers come back
 * within 5 s after Janus does (docs/janus.md).
 */
const FIRST_RETRY_MS = 250;
const MOST_RETRY_MS = 5000;
/**
 * The largest answer of Janus that is read, bytes. Chosen: far above a mountpoint's description, some
 * kilobytes.
 */
const MAX_MESSAGE_BYTES = 256 * 1024;

/**
 * Keeps a mountpoint at Janus: creates it, creates it again when Janus has restarted or somebody has destroyed it, and
 * asks how many watch.
 */
export class MountpointKeeper {
  readonly #parts: MountpointKeeperParts;
  readonly #events: MountpointKeeperEvents;
  readonly #backoff = new Backoff({ firstMs: FIRST_RETRY_MS, mostMs: MOST_RETRY_MS, random: Math.random });
  readonly #closing = new AbortController();
  /** With the admin key, a robot that was restarted can remove the mountpoint of its former life. */
  readonly #secret: string;
  #client: StreamingClient | null = null;
  #running: Promise<void> | null = null;
  #wake = new AbortController();
  #described = false;
  /** The mountpoint exists, as far as we know. */
  #exists = false;
  /** A connection was lost since the mountpoint was last seen. */
  #lost = false;
  /** Whether a failure was reported since things last worked. */
  #reported = false;
  /** How often a mountpoint was created. */
  created = 0;

  constructor(parts: MountpointKeeperParts, events: MountpointKeeperEvents) {
    this.#parts = parts;
    this.#events = events;
    const { adminKey, mountpoint } = parts.options;
    this.#secret = createHmac('sha256', adminKey?.reveal() ?? '')
      .update(`farpoint mountpoint ${mountpoint}`)
      .digest('hex');
  }

  start(): void {
    this.#running ??= this.#run();
  }

  /** What viewers are told has changed. */
  describe(): void {
    this.#described = false;
    this.#wake.abort();
  }

  /** Removes the mountpoint. */
  async close(): Promise<void> {
    this.#closing.abort();
    this.#wake.abort();
    const client = this.#client;
    if (client !== null && this.#exists)
      await client.destroy(this.#parts.options.mountpoint, this.#secret).catch(() => undefined);
    client?.close();
    await this.#running;
  }

  async #run(): Promise<void> {
    const { log, options } = this.#parts;
    while (!this.#closed) {
      try {
        this.#client = await StreamingClient.connect(
          { open: () => this.#open() },
          {
            onClosed: () => {
              this.#lost = true;
              this.#wake.abort();
            },
          },
        );
        await this.#tend(this.#client);
      } catch (error) {
        if (this.#closed) break;
        const waitMs = this.#backoff.nextMs();
        const facts = { url: options.url, detail: detailOf(error), remedy: remedyOf(error) };
        if (this.#reported) log.debug(facts, 'still no broadcast');
        else log.warn(facts, 'no broadcast; will keep trying silently');
        this.#reported = true;
        this.#lost = true;
        this.#client?.close();
        this.#client = null;
        await delay(waitMs, undefined, { signal: this.#closing.signal }).catch(() => undefined);
      }
    }
  }

  /** Returns when the robot closes. @throws {JanusFailure} when the connection is of no use any more */
  async #tend(client: StreamingClient): Promise<void> {
    const { mountpoint } = this.#parts.options;
    while (!this.#closed) {
      this.#wake = new AbortController();
      try {
        if (!this.#exists) await this.#create(client);
        const { viewers } = await client.info(mountpoint, this.#secret);
        if (this.#lost) this.#events.onFoundAgain();
        this.#lost = false;
        this.#reported = false;
        this.#backoff.reset();
        if (!this.#described) {
          this.#described = true;
          await client.edit(mountpoint, this.#secret, this.#parts.metadata());
        }
        this.#events.onViewers(viewers ?? 0);
      } catch (error) {
        // Without the right secret, it is the mountpoint of somebody else.
        const isGone = error instanceof JanusFailure && error.reason === 'no-mountpoint' && this.#exists;
        if (!isGone) throw error;
        this.#exists = false;
        continue;
      }
      await delay(POLL_MS, undefined, { signal: this.#wake.signal }).catch(() => undefined);
    }
  }

  async #create(client: StreamingClient): Promise<void> {
    const { options, name, media, metadata, log } = this.#parts;
    const { mountpoint: id, adminKey, pin, host } = options;
    await client.destroy(id, this.#secret).catch((error: unknown) => {
      if (!(error instanceof JanusFailure && error.reason === 'no-mountpoint')) throw error;
    });
    const target = host ?? new URL(options.url).hostname.replaceAll(/^\[|\]$/g, '');
    const here = isLoopback(target);
    const srtp = here ? null : randomBytes(SRTP_CM_MASTER_BYTES);
    // Janus listens at 127.0.0.1 rather than at ::1.
    const { address } = await lookup(target, target === 'localhost' ? { family: 4 } : {});
    const { ports } = await client.create({
      id,
      adminKey: adminKey?.reveal() ?? null,
      pin: pin?.reveal() ?? null,
      media,
      srtp,
      secret: this.#secret,
      metadata: metadata(),
      name: `farpoint-${id}`,
      description: name,
      address: here ? address : null,
    });
    const byMid = new Map(
      ports.map(({ mid, port, rtcp_port: rtcpPort }) => [mid, { port, rtcpPort: rtcpPort ?? null }]),
    );
    const streams = media.map(({ mid }) => byMid.get(mid));
    if (streams.includes(undefined)) throw new JanusFailure('malformed', 'Janus has not opened all ports');
    this.#exists = true;
    this.#described = true;
    this.#lost = false;
    this.created++;
    log.info({ url: options.url, mountpoint: id, encrypted: srtp !== null }, 'broadcast: mountpoint created');
    this.#events.onMountpoint({ address, ports: streams as StreamPorts[], srtp });
  }

  #open(): WebSocket {
    const { url, ca } = this.#parts.options;
    const socket = new WebSocket(url, 'janus-protocol', {
      perMessageDeflate: false,
      maxPayload: MAX_MESSAGE_BYTES,
      ...(ca === null ? {} : { ca }),
    });
    // Without a listener, an error after it was closed would end the program.
    socket.on('error', () => undefined);
    return socket;
  }

  get #closed(): boolean {
    return this.#closing.signal.aborted;
  }
}

function detailOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

function remedyOf(error: unknown): string {
  const reason = error instanceof JanusFailure ? error.reason : 'unreachable';
  switch (reason) {
    case 'unauthorised':
      return 'set broadcast.adminKey to the admin_key of Janus’ streaming plugin; if it is right, another robot has the mountpoint: choose another broadcast.mountpoint';
    case 'plugin':
      return 'choose another broadcast.mountpoint, or give Janus more ports (rtp_port_range)';
    case 'refused':
    case 'malformed':
      return 'check that broadcast.janus is the WebSocket of a Janus 1.1 with its streaming plugin';
    default:
      return 'check broadcast.janus, and that Janus runs (`pnpm janus` starts one)';
  }
}
