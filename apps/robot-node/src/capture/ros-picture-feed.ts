import { decoderOf, type RosFault, type RosGraph, type TopicEntry } from '@farpoint/ros';
import { readPicture } from '../pictures/picture-message.ts';
import type { PictureTaker } from '../pictures/source-picture.ts';
import { type Listener, listenBytes } from './ros-listener.ts';

/** When a message's picture was taken, robot's clock, ms. */
export type CaptureTime = (stampNs: bigint, receivedMs: number) => number;

/** Pictures for people to look at. A topic that nobody watches is not subscribed. */
export class RosPictureFeed {
  onFault: ((fault: RosFault) => void) | null = null;
  taker: PictureTaker | null = null;
  readonly #graph: RosGraph;
  readonly #entries: readonly TopicEntry[];
  readonly #listeners = new Map<number, Listener>();
  readonly #captureTime: CaptureTime;

  /** @param entries the topics; a camera's number is its place among them */
  constructor(graph: RosGraph, entries: readonly TopicEntry[], captureTime: CaptureTime) {
    this.#graph = graph;
    this.#entries = entries;
    this.#captureTime = captureTime;
  }

  /** Subscribes what is to be shown, and nothing else. @param perSecond of each camera; 0: nobody watches */
  watch(perSecond: readonly number[]): void {
    for (const [camera, entry] of this.#entries.entries()) {
      const listener = this.#listeners.get(camera);
      if ((perSecond[camera] ?? 0) > 0) {
        if (listener === undefined) this.#listeners.set(camera, this.#listen(camera, entry));
      } else if (listener !== undefined) {
        listener.close();
        this.#listeners.delete(camera);
      }
    }
  }

  close(): void {
    this.watch([]);
  }

  #listen(camera: number, entry: TopicEntry): Listener {
    const decode = decoderOf(this.#graph.version, entry.type, null);
    const onFault = (fault: RosFault) => this.onFault?.(fault);
    // How many are taken is the taker's to say.
    return listenBytes(this.#graph, entry, { queue: 1, limited: false, onFault }, (bytes, receivedMs) => {
      const { taker } = this;
      if (taker === null || !taker.wants(camera, receivedMs)) return;
      const { stampNs, facts, data } = readPicture(entry.type, decode(bytes));
      taker.offer({ camera, capturedAtMs: this.#captureTime(stampNs, receivedMs), facts, data });
    });
  }
}
