import type { OnMessage, Qos, RosFault, Subscription } from '@farpoint/ros';
import { type Addon, type GraphHandle, qosArguments, type ReaderHandle } from './addon.ts';
import { encapsulationFault } from './encapsulation.ts';
import { type MatchedEndpoint, readMatched } from './service-servers.ts';

/** Buffer size for small messages; grows to the largest that arrives. */
const FIRST_ROOM_BYTES = 4096;

export interface ReaderOptions {
  topic: string;
  ddsTopic: string;
  ddsType: string;
  qos: Qos;
  queue: number;
  /** Told to all that match. */
  userData?: string;
}

export interface SubscriptionEvents {
  onMessage: OnMessage;
  onFault: (fault: RosFault) => void;
  onClose: (subscription: DdsSubscription) => void;
  now: () => number;
}

/** Delivers messages from one reusable buffer: one copy, made outside the queue's lock. */
export class DdsSubscription implements Subscription {
  readonly topic: string;
  readonly definition = null;
  readonly #addon: Addon;
  readonly #events: SubscriptionEvents;
  readonly #reader: ReaderHandle;
  readonly #receivedMs = new Float64Array(1);
  readonly #counts = new Float64Array(4);
  #room = new Uint8Array(FIRST_ROOM_BYTES);
  /** Consecutive bad messages with the same fault are reported once. */
  #toldFault: string | null = null;
  #closed = false;

  constructor(addon: Addon, graph: GraphHandle, options: ReaderOptions, events: SubscriptionEvents) {
    const { topic, ddsTopic, ddsType, qos, queue, userData = '' } = options;
    this.topic = topic;
    this.#addon = addon;
    this.#events = events;
    const onMessages = () => this.drain();
    const offered = qosArguments(qos);
    this.#reader = addon.subscribe(graph, ddsTopic, ddsType, ...offered, userData, queue, onMessages);
  }

  get received(): number {
    return this.#count(0);
  }

  get dropped(): number {
    return this.#count(1);
  }

  /** Messages that never arrived, according to gaps in the publishers' sequence numbers. */
  get lost(): number {
    return this.#count(2);
  }

  get publishers(): number {
    return this.#closed ? 0 : this.#count(3);
  }

  /** Who publishes it now. */
  get matched(): MatchedEndpoint[] {
    return this.#closed ? [] : readMatched(this.#addon.matchedWriters(this.#reader));
  }

  close(): void {
    if (this.#closed) return;
    this.#count(0);
    this.#closed = true;
    this.#addon.closeReader(this.#reader);
    this.#events.onClose(this);
  }

  /** Delivers what waits now; later messages trigger another call, so that nothing else starves. */
  drain(): void {
    if (this.#closed) return;
    for (let left = this.#addon.rest(this.#reader); left > 0 && !this.#closed; left--) {
      const bytes = this.#take();
      if (bytes === null) return;
      const fault = encapsulationFault(this.topic, bytes);
      if (fault === null) {
        this.#toldFault = null;
        this.#events.onMessage(bytes, this.#whenReceived());
      } else if (fault.message !== this.#toldFault) {
        this.#toldFault = fault.message;
        this.#events.onFault(fault);
      }
    }
  }

  #take(): Uint8Array | null {
    for (;;) {
      const size = this.#addon.take(this.#reader, this.#room, this.#receivedMs);
      if (size < 0) return null;
      if (size <= this.#room.length) return this.#room.subarray(0, size);
      // Later messages have about the same size, often slightly more.
      this.#room = new Uint8Array(Math.ceil(size * 1.25));
    }
  }

  /** By the configured clock. */
  #whenReceived(): number {
    const ageMs = Number(process.hrtime.bigint()) / 1e6 - (this.#receivedMs[0] as number);
    return this.#events.now() - Math.max(0, ageMs);
  }

  #count(index: number): number {
    if (!this.#closed) this.#addon.readerCounts(this.#reader, this.#counts);
    return this.#counts[index] as number;
  }
}
