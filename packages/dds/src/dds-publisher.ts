import type { Publisher, Qos } from '@farpoint/ros';
import { type Addon, type GraphHandle, qosArguments, type WriterHandle } from './addon.ts';
import { encapsulationFault } from './encapsulation.ts';
import { type MatchedEndpoint, readMatched } from './service-servers.ts';

export interface WriterOptions {
  topic: string;
  ddsTopic: string;
  ddsType: string;
  qos: Qos;
  /** Told to all that match. */
  userData?: string;
}

export class DdsPublisher implements Publisher {
  readonly topic: string;
  readonly #addon: Addon;
  readonly #writer: WriterHandle;
  readonly #onClose: (publisher: DdsPublisher) => void;
  #refused = 0;
  #closed = false;

  constructor(
    addon: Addon,
    graph: GraphHandle,
    { topic, ddsTopic, ddsType, qos, userData = '' }: WriterOptions,
    onClose: (publisher: DdsPublisher) => void,
  ) {
    this.topic = topic;
    this.#addon = addon;
    this.#onClose = onClose;
    this.#writer = addon.advertise(graph, ddsTopic, ddsType, ...qosArguments(qos), userData);
  }

  get subscribers(): number {
    return this.#closed ? 0 : this.#addon.subscribers(this.#writer);
  }

  /** Who reads it now. */
  get matched(): MatchedEndpoint[] {
    return this.#closed ? [] : readMatched(this.#addon.matchedReaders(this.#writer));
  }

  /** Messages that were refused because a reliable subscriber was too slow. */
  get refused(): number {
    return this.#refused;
  }

  /** @throws {RosFault} `bad-message` if the message is not CDR */
  publish(bytes: Uint8Array): void {
    if (this.#closed) return;
    const fault = encapsulationFault(this.topic, bytes);
    if (fault !== null) throw fault;
    if (!this.#addon.write(this.#writer, bytes)) this.#refused++;
  }

  close(): void {
    if (this.#closed) return;
    this.#closed = true;
    this.#addon.closeWriter(this.#writer);
    this.#onClose(this);
  }
}
