import type { CaptureRoom } from '@farpoint/cloud-source';
import {
  cameraInfoSchema,
  colourOf,
  decoderOf,
  depthOf,
  GREY,
  type Image,
  type ImagePair,
  ImagePairs,
  imageSchema,
  type MessageSlot,
  MessageSlots,
  type Pinhole,
  pinholeOf,
  RosFault,
  type RosGraph,
  stampNs,
  type TopicEntry,
} from '@farpoint/ros';
import { type Listener, listen, listenBytes } from '../../ground/ros/ros-listener.ts';
import type { FedFrame, FeedShape, RosFeed } from './ros-feed.ts';

export interface ImageFeedOptions {
  depth: TopicEntry;
  colour: TopicEntry | undefined;
  cameraInfo: TopicEntry;
}

interface Picture {
  stampNs: bigint;
  slot: MessageSlot;
  image: Image;
  receivedMs: number;
}

interface CameraShape {
  width: number;
  height: number;
  camera: Pinhole;
}

/** Depth images of one camera, paired with the colour images taken at the same time. */
export class RosImageFeed implements RosFeed {
  readonly listeners: Listener[] = [];
  shape: FeedShape | null = null;
  onFrame: (() => void) | null = null;
  onFault: ((fault: RosFault) => void) | null = null;
  readonly #options: ImageFeedOptions;
  readonly #slots = new MessageSlots();
  readonly #pairs: ImagePairs<Picture>;
  readonly #decode: (bytes: Uint8Array) => unknown;
  #camera: CameraShape | null = null;
  #waiting: ImagePair<Picture> | null = null;

  constructor(graph: RosGraph, options: ImageFeedOptions) {
    const { depth, colour, cameraInfo } = options;
    this.#options = options;
    this.#pairs = new ImagePairs(({ slot }) => this.#slots.release(slot));
    this.#decode = decoderOf(graph.version, depth.type, null);
    const onFault = (fault: RosFault) => this.onFault?.(fault);
    this.listeners.push(
      listen(graph, cameraInfo, { queue: 1, onFault }, (message) => this.#takeCamera(message)),
    );
    this.listeners.push(
      listenBytes(graph, depth, { queue: 2, onFault }, (bytes, receivedMs) => {
        const picture = this.#keep(bytes, receivedMs);
        this.#offer(colour === undefined ? { depth: picture, colour: null } : this.#pairs.depth(picture));
      }),
    );
    if (colour === undefined) return;
    this.listeners.push(
      listenBytes(graph, colour, { queue: 2, onFault }, (bytes, receivedMs) =>
        this.#offer(this.#pairs.colour(this.#keep(bytes, receivedMs))),
      ),
    );
  }

  take({ depth: depthRoom, colour: colourRoom }: CaptureRoom): FedFrame | null {
    const waiting = this.#waiting;
    const shape = this.shape;
    if (waiting === null || shape === null) return null;
    this.#waiting = null;
    const { depth, colour } = waiting;
    const { depth: depthEntry, colour: colourEntry } = this.#options;
    try {
      named(depthEntry.topic, () => depthOf(sized(depth.image, shape), depthRoom));
      if (colour === null) colourRoom.fill(GREY);
      else named(colourEntry?.topic ?? '', () => colourOf(sized(colour.image, shape), colourRoom));
      const { header } = depth.image;
      const count = shape.width * shape.height;
      return { count, frameId: header.frame_id, stampNs: depth.stampNs, receivedMs: depth.receivedMs };
    } finally {
      this.#letGo(waiting);
    }
  }

  skip(): void {
    if (this.#waiting !== null) this.#letGo(this.#waiting);
    this.#waiting = null;
  }

  close(): void {
    for (const listener of this.listeners) listener.close();
    this.skip();
  }

  #takeCamera(message: unknown): void {
    const info = cameraInfoSchema.parse(message);
    const { width, height } = info;
    const camera = pinholeOf(info);
    const before = this.#camera;
    this.#camera ??= { width, height, camera };
    if (before === null) return;
    const same =
      width === before.width &&
      height === before.height &&
      (['fx', 'fy', 'cx', 'cy'] as const).every((key) => camera[key] === before.camera[key]);
    // The encoder was made for the previous camera.
    if (!same) throw new RosFault('bad-image', 'the camera has changed', { remedy: 'restart the robot' });
  }

  /** @throws {Error} if the message is not a valid image */
  #keep(bytes: Uint8Array, receivedMs: number): Picture {
    const slot = this.#slots.keep(bytes);
    try {
      const image = imageSchema.parse(this.#decode(slot.bytes));
      return { slot, image, stampNs: stampNs(image.header.stamp), receivedMs };
    } catch (error) {
      this.#slots.release(slot);
      throw error;
    }
  }

  #offer(pair: ImagePair<Picture> | null): void {
    if (pair === null) return;
    if (this.#camera === null) {
      this.#slots.release(pair.depth.slot);
      return;
    }
    const { width, height, camera } = this.#camera;
    this.shape ??= { width, height, capacity: width * height, camera, axes: 'optical' };
    this.skip();
    // The next pair may use the same colour image.
    if (pair.colour !== null) this.#slots.retain(pair.colour.slot);
    this.#waiting = pair;
    this.onFrame?.();
  }

  #letGo({ depth, colour }: ImagePair<Picture>): void {
    this.#slots.release(depth.slot);
    if (colour !== null) this.#slots.release(colour.slot);
  }
}

/** @throws {RosFault} if it does not have the camera's size */
function sized(image: Image, { width, height }: FeedShape): Image {
  if (image.width === width && image.height === height) return image;
  throw new RosFault(
    'bad-image',
    `${image.width} × ${image.height} pixels, the camera has ${width} × ${height}`,
    {
      remedy: 'use the images that are registered to that camera',
    },
  );
}

function named(topic: string, read: () => void): void {
  try {
    read();
  } catch (error) {
    throw RosFault.of(error, topic);
  }
}
