import {
  compressedImageSchema,
  compressedPicture,
  decoderOf,
  imageSchema,
  type RosFault,
  type RosGraph,
  stampNs,
  type TopicEntry,
} from '@farpoint/ros';
import type { PictureTaker, SourcePicture } from '../pictures/source-picture.ts';
import { type Listener, listenBytes } from './ros-listener.ts';

const COMPRESSED = 'sensor_msgs/msg/CompressedImage';

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
    const read = entry.type === COMPRESSED ? readCompressed : readRaw;
    const onFault = (fault: RosFault) => this.onFault?.(fault);
    // How many are taken is the taker's to say.
    return listenBytes(this.#graph, entry, { queue: 1, limited: false, onFault }, (bytes, receivedMs) => {
      const { taker } = this;
      if (taker === null || !taker.wants(camera, receivedMs)) return;
      const { stamp, facts, data } = read(decode(bytes));
      taker.offer({ camera, captureMs: this.#captureTime(stamp, receivedMs), facts, data });
    });
  }
}

type Read = Pick<SourcePicture, 'facts' | 'data'> & { stamp: bigint };

function readRaw(message: unknown): Read {
  const { header, width, height, step, encoding, is_bigendian, data } = imageSchema.parse(message);
  const facts = { kind: 'raw', width, height, step, encoding, bigEndian: Boolean(is_bigendian) } as const;
  return { stamp: stampNs(header.stamp), facts, data };
}

/** @throws {RosFault} for what is neither JPEG nor PNG */
function readCompressed(message: unknown): Read {
  const image = compressedImageSchema.parse(message);
  const facts = { kind: 'file', ...compressedPicture(image) } as const;
  return { stamp: stampNs(image.header.stamp), facts, data: image.data };
}
