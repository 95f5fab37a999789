import type { CaptureRoom } from '@farpoint/cloud-source';
import {
  axesOf,
  type CameraInfo,
  type CloudAxes,
  cameraInfoSchema,
  checkedCount,
  decoderOf,
  type MessageSlot,
  MessageSlots,
  type Pinhole,
  type PointCloud2,
  PointCloud2Decoder,
  pinholeOf,
  pointCloud2Schema,
  RosFault,
  type RosGraph,
  stampNs,
  type TopicEntry,
} from '@farpoint/ros';
import { type Listener, listen, listenBytes } from '../../ground/ros/ros-listener.ts';
import type { FedFrame, FeedShape, RosFeed } from './ros-feed.ts';

/** A LiDAR's clouds vary in size. Room for this many times the first cloud, and at least this many points. */
const HEADROOM = 2;
const LEAST_CAPACITY = 131_072;
/** The most that a point of a grid may deviate from its pixel, pixels. */
const MOST_OFF = 1.5;
const POINTS_CHECKED = 64;
const WORD_BYTES = 4;

export interface CloudFeedOptions {
  cloud: TopicEntry;
  /** If given, clouds on this camera's grid are treated as images. */
  cameraInfo: TopicEntry | undefined;
  axes: CloudAxes | 'auto';
}

interface WaitingCloud {
  slot: MessageSlot;
  cloud: PointCloud2;
  receivedMs: number;
}

/** Clouds of one topic, from a LiDAR or a depth camera. Only the newest is kept. */
export class RosCloudFeed implements RosFeed {
  readonly listeners: Listener[] = [];
  shape: FeedShape | null = null;
  onFrame: (() => void) | null = null;
  onFault: ((fault: RosFault) => void) | null = null;
  readonly #options: CloudFeedOptions;
  readonly #decoder = new PointCloud2Decoder();
  readonly #slots = new MessageSlots();
  readonly #decode: (bytes: Uint8Array) => unknown;
  #camera: CameraInfo | null = null;
  #waiting: WaitingCloud | null = null;
  #lead = 0;

  constructor(graph: RosGraph, options: CloudFeedOptions) {
    this.#options = options;
    const { cloud, cameraInfo } = options;
    this.#decode = decoderOf(graph.version, cloud.type, null);
    const onFault = (fault: RosFault) => this.onFault?.(fault);
    if (cameraInfo !== undefined) {
      const listener = listen(graph, cameraInfo, { queue: 1, onFault }, (message) => {
        this.#camera = cameraInfoSchema.parse(message);
      });
      this.listeners.push(listener);
    }
    this.listeners.push(
      listenBytes(graph, cloud, { queue: 1, onFault }, (bytes, receivedMs) => this.#keep(bytes, receivedMs)),
    );
  }

  get rings(): readonly number[] | null {
    return this.#decoder.rings;
  }

  take(room: CaptureRoom): FedFrame | null {
    const waiting = this.#waiting;
    const shape = this.shape;
    if (waiting === null || shape === null) return null;
    this.#waiting = null;
    try {
      const { cloud, receivedMs } = waiting;
      const { header } = cloud;
      if (shape.camera !== null && (cloud.width !== shape.width || cloud.height !== shape.height)) {
        const size = `${cloud.width} × ${cloud.height} points, ${shape.width} × ${shape.height} before`;
        throw new RosFault('bad-cloud', size, { remedy: 'restart the robot' });
      }
      const count =
        shape.camera === null
          ? // Each form is created when it is read, and this may move the other. Read only one.
            this.#decoder.decode(cloud, shape.axes, room.points)
          : this.#decoder.decodeImages(cloud, room.depth, room.colour);
      return { count, frameId: header.frame_id, stampNs: stampNs(header.stamp), receivedMs };
    } catch (error) {
      throw RosFault.of(error, this.#options.cloud.topic);
    } finally {
      this.#slots.release(waiting.slot);
    }
  }

  skip(): void {
    if (this.#waiting !== null) this.#slots.release(this.#waiting.slot);
    this.#waiting = null;
  }

  close(): void {
    for (const listener of this.listeners) listener.close();
    this.skip();
  }

  #keep(bytes: Uint8Array, receivedMs: number): void {
    // The camera decides the form of the frames, so nothing is shown before it is known.
    if (this.shape === null && this.#options.cameraInfo !== undefined && this.#camera === null) return;
    let slot = this.#slots.keep(bytes, this.#lead);
    let cloud: PointCloud2;
    try {
      cloud = pointCloud2Schema.parse(this.#decode(slot.bytes));
      const off = cloud.data.byteOffset % WORD_BYTES;
      if (off !== 0) {
        // Aligned points are read as words without a copy. The next cloud with the same header is then aligned.
        this.#lead = (this.#lead + WORD_BYTES - off) % WORD_BYTES;
        this.#slots.release(slot);
        slot = this.#slots.keep(bytes, this.#lead);
        cloud = pointCloud2Schema.parse(this.#decode(slot.bytes));
      }
      this.shape ??= this.#shapeOf(cloud);
    } catch (error) {
      this.#slots.release(slot);
      throw error;
    }
    this.skip();
    this.#waiting = { slot, cloud, receivedMs };
    this.onFrame?.();
  }

  /** @throws {RosFault} if the message is not a valid cloud */
  #shapeOf(cloud: PointCloud2): FeedShape {
    const count = checkedCount(cloud);
    const { width, height, header } = cloud;
    const axes = this.#options.axes === 'auto' ? axesOf(header.frame_id) : this.#options.axes;
    const grid = height > 1;
    const capacity = grid ? count : Math.max(count * HEADROOM, LEAST_CAPACITY);
    const shape = { width: grid ? width : capacity, height: grid ? height : 1, capacity, camera: null, axes };
    if (this.#camera === null) return shape;
    const camera = pinholeOf(this.#camera);
    const reason = this.#whyNoPicture(cloud, axes, this.#camera, camera);
    if (reason === null) return { ...shape, camera };
    const { cameraInfo } = this.#options;
    this.onFault?.(
      new RosFault(
        'bad-cloud',
        `its clouds are no pictures of that camera: ${reason}; they are sent as points`,
        {
          ...(cameraInfo === undefined ? {} : { topic: cameraInfo.topic }),
        },
      ),
    );
    return shape;
  }

  /** @returns why the cloud is not an image; `null` if each point lies at its pixel */
  #whyNoPicture(cloud: PointCloud2, axes: CloudAxes, info: CameraInfo, camera: Pinhole): string | null {
    const { width, height } = cloud;
    if (axes !== 'optical') return `the frame ${cloud.header.frame_id} is not optical`;
    if (width !== info.width || height !== info.height) {
      return `${width} × ${height} points and ${info.width} × ${info.height} pixels`;
    }
    const points = new Float32Array(width * height * 4);
    const count = this.#decoder.decode(cloud, axes, points);
    const step = Math.max(1, Math.floor(count / POINTS_CHECKED));
    for (let i = 0; i < count; i += step) {
      const [x, y, z] = points.subarray(i * 4, i * 4 + 3) as unknown as [number, number, number];
      if (!(z > 0 && Number.isFinite(x + y + z))) continue;
      const offU = Math.abs((x / z) * camera.fx + camera.cx - (i % width));
      const offV = Math.abs((y / z) * camera.fy + camera.cy - Math.floor(i / width));
      const off = Math.max(offU, offV);
      if (off > MOST_OFF) return `a point lies ${off.toFixed(1)} pixels beside its own`;
    }
    return null;
  }
}
