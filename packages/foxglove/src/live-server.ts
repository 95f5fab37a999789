import type { LiveMessage } from './client-backlog.ts';
import { type ClientRefusal, LiveClient, type LiveSocket } from './live-client.ts';
import { advertise, type Channel, type ChannelSpec, type ServerName, serverInfo } from './server-message.ts';

export interface LiveServerEvents {
  /** The set of channels with at least one subscriber has changed. */
  onInterest(): void;
  /** A subscriber of this channel can go on with a key message only. */
  onKeyNeeded(channel: number): void;
}

export interface LiveCounts {
  clients: number;
  subscriptions: number;
  /** Sent to all clients so far. */
  messages: number;
  bytes: number;
  /** Not sent because a client reads too slowly. */
  dropped: number;
  /** What clients sent and was not obeyed, by reason. */
  refused: Readonly<Partial<Record<ClientRefusal, number>>>;
}

/** The state of a server of live channels, without its sockets. */
export class LiveServer {
  readonly #name: ServerName;
  readonly #events: LiveServerEvents;
  readonly #channels: Channel[] = [];
  readonly #clients = new Set<LiveClient>();
  readonly #refused: Partial<Record<ClientRefusal, number>> = {};
  #interest: ReadonlySet<number> = new Set();
  /** Of clients that are gone. */
  #past = { messages: 0, bytes: 0, dropped: 0 };
  readonly #sockets = new Map<LiveClient, LiveSocket>();

  constructor(name: ServerName, events: LiveServerEvents) {
    this.#name = name;
    this.#events = events;
  }

  /** @returns the channel's number, from 1 */
  addChannel({ topic, messageEncoding, schema }: ChannelSpec): number {
    const channel = { id: this.#channels.length + 1, topic, messageEncoding, schema };
    this.#channels.push(channel);
    for (const socket of this.#sockets.values()) socket.sendText(advertise([channel]));
    return channel.id;
  }

  /** Whether anybody subscribes to the channel. Nothing need be made for one that nobody wants. */
  wants(channel: number): boolean {
    return this.#interest.has(channel);
  }

  get counts(): LiveCounts {
    const counts = { ...this.#past, clients: this.#clients.size, subscriptions: 0 };
    for (const client of this.#clients) {
      counts.subscriptions += [...client.channels].length;
      counts.messages += client.messages;
      counts.bytes += client.bytes;
      counts.dropped += client.dropped;
    }
    return { ...counts, refused: { ...this.#refused } };
  }

  /** A client has connected. Call {@link remove} when its connection is gone. */
  accept(socket: LiveSocket): LiveClient {
    const client: LiveClient = new LiveClient(socket, {
      hasChannel: (id) => id >= 1 && id <= this.#channels.length,
      onInterest: () => this.#updateInterest(),
      onKeyNeeded: (channel) => this.#events.onKeyNeeded(channel),
      onRefused: (reason) => {
        this.#refused[reason] = (this.#refused[reason] ?? 0) + 1;
      },
    });
    this.#clients.add(client);
    this.#sockets.set(client, socket);
    socket.sendText(serverInfo(this.#name));
    socket.sendText(advertise(this.#channels));
    return client;
  }

  /** A client's connection is gone. */
  remove(client: LiveClient): void {
    if (!this.#clients.delete(client)) return;
    this.#sockets.delete(client);
    this.#past.messages += client.messages;
    this.#past.bytes += client.bytes;
    this.#past.dropped += client.dropped;
    client.gone();
  }

  /** Sends a message to all that subscribe to its channel. Its bytes must not be changed any more. */
  publish(message: LiveMessage): void {
    for (const client of this.#clients) client.offer(message);
  }

  #updateInterest(): void {
    const interest = new Set([...this.#clients].flatMap((client) => [...client.channels]));
    if (interest.size === this.#interest.size && [...interest].every((id) => this.#interest.has(id))) return;
    this.#interest = interest;
    this.#events.onInterest();
  }
}
