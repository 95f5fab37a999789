/** How much others may send to one peer through this service. Bounded; time is an argument. */
import { isLoopbackHost } from '@farpoint/protocol';
import { addressKey } from '@farpoint/service';
import { TokenBucket } from '@farpoint/timing';
import type { Peer } from './peer.ts';

export interface RelayLimits {
  /** To one robot, from all operators together; an operator may use a quarter of it. The same to one operator. */
  readonly relayBytesPerSecond: number;
  readonly relayMessagesPerSecond: number;
}

/** Whose budget is used up. */
export type RelayRefusal = 'sender' | 'receiver';

/** What may be sent at once, as a multiple of what may be sent in a second. */
const BURST = 4;
/** An operator's share of what a robot takes. */
const SHARE = 1 / 4;
/** The burst of an operator's share takes the longest message. */
const LEAST_BURST_BYTES = 65_536;
/** Beyond it, the address that sent longest ago is forgotten. */
const MOST_ADDRESSES = 4096;

class Budget {
  readonly #messages: TokenBucket;
  readonly #bytes: TokenBucket;

  constructor({ relayBytesPerSecond: bytes, relayMessagesPerSecond: messages }: RelayLimits, share: number) {
    this.#messages = new TokenBucket({
      perSecond: messages * share,
      burst: Math.max(1, messages * share * BURST),
    });
    const burst = Math.max(LEAST_BURST_BYTES, bytes * share * BURST);
    this.#bytes = new TokenBucket({ perSecond: bytes * share, burst });
  }

  take(bytes: number, nowMs: number): boolean {
    return this.#messages.take(nowMs) && this.#bytes.take(nowMs, bytes);
  }
}

/** The budgets of all peers of a hub. */
export class RelayBudgets {
  readonly #limits: RelayLimits;
  readonly #receivers = new WeakMap<Peer, Budget>();
  readonly #senders = new WeakMap<Peer, Budget>();
  /** Many sockets of one address are one sender. The latest used last. */
  readonly #addresses = new Map<string, Budget>();

  constructor(limits: RelayLimits) {
    this.#limits = limits;
  }

  /**
   * @param from an operator, whose share is limited as well; `null` for a robot
   * @returns why the message is not relayed; `null` if it is
   */
  refusal(from: Peer | null, to: Peer, bytes: number, nowMs: number): RelayRefusal | null {
    // First the sender's: what it sends beyond its share takes nothing from others.
    if (from !== null && !this.#sender(from).take(bytes, nowMs)) return 'sender';
    let receiver = this.#receivers.get(to);
    if (receiver === undefined) {
      receiver = new Budget(this.#limits, 1);
      this.#receivers.set(to, receiver);
    }
    return receiver.take(bytes, nowMs) ? null : 'receiver';
  }

  #sender(peer: Peer): Budget {
    // A proxy or a bridge on this machine stands for many operators.
    if (isLoopbackHost(peer.address)) {
      const budget = this.#senders.get(peer) ?? new Budget(this.#limits, SHARE);
      this.#senders.set(peer, budget);
      return budget;
    }
    const key = addressKey(peer.address);
    const budget = this.#addresses.get(key) ?? new Budget(this.#limits, SHARE);
    this.#addresses.delete(key);
    this.#addresses.set(key, budget);
    const [oldest] = this.#addresses.keys();
    if (this.#addresses.size > MOST_ADDRESSES && oldest !== undefined) this.#addresses.delete(oldest);
    return budget;
  }
}
