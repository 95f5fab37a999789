import {
  compressedImageSchema,
  decoderOf,
  type Image,
  imageSchema,
  pictureRows,
  RosFault,
  type RosGraph,
  stampNs,
  type TopicEntry,
} from '@farpoint/ros';
import type { Coding, RawFormat, RawFrame } from '@farpoint/video';
import { capturedAtMs, type RosClock } from '../../../ground/ros/capture-time.ts';
import { type Listener, listenBytes } from '../../../ground/ros/ros-listener.ts';
import { type Feed, type FeedEvents, type FeedTarget, FrameRooms } from './feed.ts';

/** The video process takes no longer side. */
const MOST_SIDE = 8192;

/** Encodings whose bytes GStreamer reads as they are, and their bytes per pixel. */
const SAME: ReadonlyMap<string, readonly [RawFormat, number]> = new Map([
  ['rgb8', ['rgb', 3]],
  ['bgr8', ['bgr', 3]],
  ['8UC3', ['bgr', 3]],
  ['rgba8', ['rgba', 4]],
  ['bgra8', ['bgra', 4]],
  ['8UC4', ['bgra', 4]],
  ['mono8', ['gray', 1]],
  ['8UC1', ['gray', 1]],
  ['yuv422', ['uyvy', 2]],
  ['uyvy', ['uyvy', 2]],
  ['yuv422_yuy2', ['yuy2', 2]],
  ['yuyv', ['yuy2', 2]],
]);
/** Of a pixel. */
const RGBA_BYTES = 4;

/**
 * @param room gives memory for the picture; the image's own is valid only during the call
 * @throws {RosFault} `bad-image`, `unsupported`, `too-large`
 */
export function imageFrame(image: Image, captureNs: bigint, room: (bytes: number) => Uint8Array): RawFrame {
  const { width, height, step, encoding, data } = image;
  // Checks the sizes, too.
  const rows = pictureRows(image);
  if (Math.max(width, height) > MOST_SIDE)
    throw new RosFault('too-large', `${width} × ${height} pixels, at most ${MOST_SIDE} a side`);
  const [format, pixelBytes] = SAME.get(encoding) ?? (['rgba', RGBA_BYTES] as const);
  const stride = width * pixelBytes;
  const bytes = room(stride * height);
  if (!SAME.has(encoding)) {
    for (let row = 0; row < height; row++)
      rows.readRow(row, bytes.subarray(row * stride, (row + 1) * stride));
  } else if (step === stride) {
    bytes.set(data.subarray(0, bytes.length));
  } else {
    for (let row = 0; row < height; row++)
      bytes.set(data.subarray(row * step, row * step + stride), row * stride);
  }
  return { captureNs, format, width, height, stride, bytes };
}

const COMPRESSED = 'sensor_msgs/msg/CompressedImage';
/** Messages that may wait in the graph. Where each picture builds on those before it, none may be missing. */
const QUEUE = { raw: 1, compressed: 8 };
/**
 * A topic that is silent for so long is told to people, ms. Chosen: longer than publishers that start take;
 * the page has said that pictures are old since the first second (docs/ros.md).
 */
const SILENT_MS = 5000;

/** The pictures of one topic, as they are: nothing is encoded before it is video. */
export class RosVideoFeed implements Feed {
  readonly #graph: RosGraph;
  readonly #entry: TopicEntry;
  readonly #clock: RosClock;
  readonly #target: FeedTarget;
  readonly #events: FeedEvents;
  readonly #decode: (bytes: Uint8Array) => unknown;
  readonly #listener: Listener;
  readonly #rooms = new FrameRooms();
  #heardMs: number;

  /** Subscribes. @throws {RosFault} if the graph cannot */
  constructor(graph: RosGraph, entry: TopicEntry, clock: RosClock, target: FeedTarget, events: FeedEvents) {
    this.#graph = graph;
    this.#entry = entry;
    this.#clock = clock;
    this.#target = target;
    this.#events = events;
    this.#heardMs = clock.now();
    const compressed = entry.type === COMPRESSED;
    this.#decode = decoderOf(graph.version, entry.type, null);
    const queue = compressed ? QUEUE.compressed : QUEUE.raw;
    const onFault = (fault: RosFault) => events.onFault(fault.message);
    this.#listener = listenBytes(graph, entry, { queue, onFault }, (bytes, receivedMs) => {
      this.#heardMs = receivedMs;
      if (compressed) this.#takeCompressed(bytes, receivedMs);
      else this.#takeImage(bytes, receivedMs);
    });
  }

  /** Call each second or so: says so if the topic is silent. */
  check(nowMs: number): void {
    if (nowMs - this.#heardMs >= SILENT_MS) this.#events.onFault(this.#whySilent().message);
  }

  close(): void {
    this.#listener.close();
  }

  #takeImage(message: Uint8Array, receivedMs: number): void {
    // The process still reads the one before: a newer one will come.
    if (!this.#target.takes) return;
    const image = imageSchema.parse(this.#decode(message));
    const captureNs = this.#captureNs(stampNs(image.header.stamp), receivedMs);
    this.#target.pushFrame(imageFrame(image, captureNs, (bytes) => this.#rooms.room(bytes)));
    this.#rooms.swap();
  }

  #takeCompressed(message: Uint8Array, receivedMs: number): void {
    const { header, format, data } = compressedImageSchema.parse(this.#decode(message));
    const coding = codingOf(format, data);
    if (data.length === 0) throw new RosFault('bad-image', 'a compressed picture without bytes');
    const captureNs = this.#captureNs(stampNs(header.stamp), receivedMs);
    if (coding === 'h264') {
      // Several may be on their way.
      this.#target.pushCoded({ captureNs, coding, bytes: data.slice() });
      return;
    }
    if (!this.#target.takes) return;
    const bytes = this.#rooms.room(data.length);
    bytes.set(data);
    this.#target.pushCoded({ captureNs, coding, bytes });
    this.#rooms.swap();
  }

  #captureNs(stamp: bigint, receivedMs: number): bigint {
    const now = this.#clock.now();
    return BigInt(Math.round(Math.min(capturedAtMs(this.#clock, stamp, receivedMs), now) * 1e6));
  }

  #whySilent(): RosFault {
    const { topic, type } = this.#entry;
    const others = this.#graph.topics().filter((each) => each.topic === topic && each.publishers > 0);
    const same = others.find((each) => each.type === type);
    const [other] = others;
    if (same === undefined && other !== undefined)
      return new RosFault('wrong-type', `it has ${other.type}, not ${type}`, {
        topic,
        remedy: 'set the camera’s type, or name another topic',
      });
    const within = `for ${SILENT_MS / 1000} s`;
    return (same?.publishers ?? this.#listener.publishers) > 0
      ? new RosFault('unavailable', `no picture ${within}, although it is published`, { topic })
      : new RosFault('unavailable', `nobody publishes it (no picture ${within})`, { topic });
  }
}

/** @throws {RosFault} `unsupported` */
function codingOf(format: string, data: Uint8Array): Coding {
  if (data[0] === 0xff && data[1] === 0xd8) return 'jpeg';
  if (data[0] === 0x89 && data[1] === 0x50) return 'png';
  // As in `h264` or `bgr8; h264 compressed`.
  if (/\bh\.?264\b/i.test(format)) return 'h264';
  throw new RosFault(
    'unsupported',
    `a compressed picture (${format.slice(0, 64) || 'no format'}) that is neither JPEG, PNG nor H.264`,
    { remedy: 'name the topic of the raw image' },
  );
}
