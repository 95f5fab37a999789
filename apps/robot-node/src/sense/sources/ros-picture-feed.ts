import type { PictureTaker } from '@farpoint/cloud-source';
import { decoderOf, type RosFault, type RosGraph, type TopicEntry } from '@farpoint/ros';
import type { CaptureTime } from '../../ground/ros/capture-time.ts';
import { type Listener, listenBytes } from '../../ground/ros/ros-listener.ts';
import { readPicture } from '../pictures/picture-message.ts';

/** Pictures for people to look at. A topic that nobody watches has no subscription. */
export class RosPictureFeed {
  onFault: ((fault: RosFault) => void) | null = null;
  taker: PictureTaker | null = null;
  readonly #graph: RosGraph;
  readonly #entries: readonly TopicEntry[];
  readonly #listeners = new Map<number, Listener>();
  readonly #captureTime: CaptureTime;

  /** @param entries the topics; the index among them is the camera's number */
  constructor(graph: RosGraph, entries: readonly TopicEntry[], captureTime: CaptureTime) {
    this.#graph = graph;
    this.#entries = entries;
    this.#captureTime = captureTime;
  }

  /**
   * Subscribes to the watched topics and no others. @param perSecond pictures per second for each camera; 0: nobody
   * watches
   */
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
    // The receiver limits the rate.
    return listenBytes(this.#graph, entry, { queue: 1, limited: false, onFault }, (bytes, receivedMs) => {
      const { taker } = this;
      if (taker === null || !taker.wants(camera, receivedMs)) return;
      const { stampNs, facts, data } = readPicture(entry.type, decode(bytes));
      taker.offer({ camera, capturedAtMs: this.#captureTime(stampNs, receivedMs), facts, data });
    });
  }
}
