import { TokenBucket } from '@farpoint/timing';
import { ClientBacklog, type LiveMessage } from './client-backlog.ts';
import { ClientMessageError, type MessageRefusal, parseClientMessage } from './client-message.ts';
import { messageHead, status } from './server-message.ts';

/** What waits for a client, at most: some large clouds, or minutes of everything else. */
const BACKLOG_LIMITS = { bytes: 32 * 1024 * 1024, messages: 4096 };
/** Bytes that the socket may hold; the rest waits where the oldest can be dropped. */
const MOST_UNDER_WAY = 512 * 1024;
/** Messages that a client may send. Viewers send a few when a panel opens. */
const MESSAGE_RATE = { perSecond: 50, burst: 200 };
/** After so many messages that are not obeyed, a client is not one of ours. */
const MOST_REFUSALS = 32;
const MOST_SUBSCRIPTIONS = 1024;
/** Codes of RFC 6455 for closing. */
const POLICY_VIOLATION = 1008;

/** A client's connection. */
export interface LiveSocket {
  sendText(text: string): void;
  /** Sends one binary message. @param done called when it has left, or the connection is lost */
  send(parts: readonly Uint8Array[], done: () => void): void;
  close(code: number, reason: string): void;
}

export type ClientRefusal =
  | MessageRefusal
  | 'no-channel' // a subscription to a channel that does not exist
  | 'subscribed-already' // the id or the channel is in use by this client
  | 'too-many'; // too many subscriptions, or messages in a short time

export interface LiveClientEvents {
  hasChannel(channel: number): boolean;
  /** The client's subscriptions have changed. */
  onInterest(): void;
  /** A channel can go on with a key message only. */
  onKeyNeeded(channel: number): void;
  onRefused(reason: ClientRefusal): void;
}

/** One connected viewer: its subscriptions, and what is on its way to it. */
export class LiveClient {
  messages = 0;
  bytes = 0;
  readonly #socket: LiveSocket;
  readonly #events: LiveClientEvents;
  /** Subscription ids by channel, and the other way round. */
  readonly #subscriptions = new Map<number, number>();
  readonly #channels = new Map<number, number>();
  readonly #backlog = new ClientBacklog(BACKLOG_LIMITS);
  readonly #bucket = new TokenBucket(MESSAGE_RATE);
  #underWay = 0;
  #refusals = 0;
  #closed = false;

  constructor(socket: LiveSocket, events: LiveClientEvents) {
    this.#socket = socket;
    this.#events = events;
    this.#backlog.onKeyNeeded = (channel) => events.onKeyNeeded(channel);
  }

  /** Messages that it did not get because it reads too slowly. */
  get dropped(): number {
    return this.#backlog.dropped;
  }

  /** Bytes that wait for it. */
  get waitingBytes(): number {
    return this.#backlog.bytes + this.#underWay;
  }

  get channels(): Iterable<number> {
    return this.#subscriptions.keys();
  }

  wants(channel: number): boolean {
    return this.#subscriptions.has(channel);
  }

  /** Takes what the client has sent, of any content. */
  receive(data: string | Uint8Array, nowMs: number): void {
    if (this.#closed) return;
    if (!this.#bucket.take(nowMs)) {
      this.#events.onRefused('too-many');
      this.#end('too many messages');
      return;
    }
    try {
      const message = parseClientMessage(data);
      if (message.op === 'subscribe') for (const each of message.subscriptions) this.#subscribe(each);
      else for (const id of message.subscriptionIds) this.#unsubscribe(id);
    } catch (error) {
      if (!(error instanceof ClientMessageError)) throw error;
      this.#refuse(error.reason, error.message);
    }
  }

  offer(message: LiveMessage): void {
    if (this.#closed || !this.wants(message.channel)) return;
    this.#backlog.push(message);
    this.#flush();
  }

  /** The connection is gone. */
  gone(): void {
    this.#closed = true;
    this.#subscriptions.clear();
    this.#events.onInterest();
  }

  #subscribe({ id, channelId }: { id: number; channelId: number }): void {
    if (!this.#events.hasChannel(channelId)) this.#refuse('no-channel', `there is no channel ${channelId}`);
    else if (this.#channels.has(id) || this.#subscriptions.has(channelId))
      this.#refuse('subscribed-already', `the subscription ${id} or the channel ${channelId} is in use`);
    else if (this.#subscriptions.size >= MOST_SUBSCRIPTIONS)
      this.#refuse('too-many', 'too many subscriptions');
    else {
      this.#channels.set(id, channelId);
      this.#subscriptions.set(channelId, id);
      this.#backlog.begin(channelId);
      this.#events.onInterest();
    }
  }

  #unsubscribe(id: number): void {
    const channel = this.#channels.get(id);
    if (channel === undefined) return;
    this.#channels.delete(id);
    this.#subscriptions.delete(channel);
    this.#backlog.forget(channel);
    this.#events.onInterest();
  }

  #flush(): void {
    while (this.#underWay < MOST_UNDER_WAY) {
      const message = this.#backlog.next();
      if (message === null) return;
      const subscription = this.#subscriptions.get(message.channel);
      if (subscription === undefined) continue;
      const { bytes, ns } = message;
      this.#underWay += bytes.length;
      this.messages++;
      this.bytes += bytes.length;
      this.#socket.send([messageHead(subscription, ns), bytes], () => {
        this.#underWay -= bytes.length;
        if (!this.#closed) this.#flush();
      });
    }
  }

  #refuse(reason: ClientRefusal, what: string): void {
    this.#events.onRefused(reason);
    this.#refusals++;
    if (this.#refusals > MOST_REFUSALS) this.#end('too many messages that are not obeyed');
    else this.#socket.sendText(status('warning', what));
  }

  #end(reason: string): void {
    this.#closed = true;
    this.#socket.close(POLICY_VIOLATION, reason);
  }
}
