import { type Pose, sequence32Of } from '@farpoint/protocol';
import { PointRoom, recordedPoints } from './captured-cloud.ts';
import { McapFileWriter } from './mcap-file-writer.ts';
import { pictureTopics, videoTopics } from './picture-topics.ts';
import {
  type CloudKind,
  type CloudRecord,
  type EventRecord,
  JSON_TOPICS,
  type JsonKind,
  type PictureRecord,
  type RecordedCamera,
  type RecordedVideo,
  type RecorderOptions,
  type VideoFormatName,
  type VideoRecord,
} from './recorder-messages.ts';
import {
  FOXGLOVE_COMPRESSED_IMAGE_SCHEMA,
  FOXGLOVE_COMPRESSED_VIDEO_SCHEMA,
  ODOMETRY_SCHEMA,
  POINT_CLOUD2_SCHEMA,
  TF_MESSAGE_SCHEMA,
  TWIST_STAMPED_SCHEMA,
} from './ros-schemas.ts';
import {
  BASE_FRAME,
  CAMERA_FRAME,
  compressedImage,
  compressedVideo,
  odometryOf,
  pointCloud2,
  transformOf,
  twistStamped,
} from './ros-writer.ts';
import type { SentCloudDecoder } from './sent-cloud.ts';

const ROS_TOPICS = {
  captured: ['/farpoint/captured', 'sensor_msgs/msg/PointCloud2', POINT_CLOUD2_SCHEMA],
  sent: ['/farpoint/sent', 'sensor_msgs/msg/PointCloud2', POINT_CLOUD2_SCHEMA],
  tf: ['/tf', 'tf2_msgs/msg/TFMessage', TF_MESSAGE_SCHEMA],
  velocity: ['/farpoint/cmd_vel', 'geometry_msgs/msg/TwistStamped', TWIST_STAMPED_SCHEMA],
  odometry: ['/odom', 'nav_msgs/msg/Odometry', ODOMETRY_SCHEMA],
} as const;
type RosKind = keyof typeof ROS_TOPICS;

/** Converts the messages of a robot's threads to messages of an MCAP file. Wait for each call before the next. */
export class RecordingWriter {
  /** Records that could not be converted to messages. */
  faults = 0;
  /** Clouds, pictures and frames of videos that never arrived here because the writer did not keep up. */
  readonly dropped: Record<CloudKind | 'pictures' | 'videos', number> = {
    ...{ captured: 0, sent: 0, pictures: 0, videos: 0 },
  };
  readonly file: McapFileWriter;
  readonly #epochNs: bigint;
  readonly #decoder: SentCloudDecoder;
  readonly #channels = new Map<RosKind | JsonKind, number>();
  #cameras: { channel: number; frame: string }[] = [];
  #videos: { channel: number; frame: string; format: VideoFormatName }[] = [];
  /** Its content is written, or copied, before the next cloud. */
  readonly #room = new PointRoom();
  #transforms = 0;
  #ownStates = 0;
  #newestNs = 0n;
  #lastTransformNs = 0n;

  private constructor(file: McapFileWriter, epochNs: bigint, decoder: SentCloudDecoder) {
    this.file = file;
    this.#epochNs = epochNs;
    this.#decoder = decoder;
    for (const [kind, [topic, name, text]] of Object.entries(ROS_TOPICS)) {
      const schema = { name, encoding: 'ros2msg' as const, text };
      this.#channels.set(kind as RosKind, file.addChannel({ topic, messageEncoding: 'cdr', schema }));
    }
    for (const [kind, topic] of Object.entries(JSON_TOPICS)) {
      this.#channels.set(kind as JsonKind, file.addChannel({ topic, messageEncoding: 'json', schema: null }));
    }
  }

  /** @throws {Error} if the file already exists or cannot be created */
  static async create(options: RecorderOptions, decoder: SentCloudDecoder): Promise<RecordingWriter> {
    const file = await McapFileWriter.create(
      options.path,
      options.compression,
      'farpoint',
      options.mostBytes,
    );
    const writer = new RecordingWriter(file, options.epochNs, decoder);
    await file.addMetadata('farpoint', { robot: options.robotId, epochNs: String(options.epochNs) });
    return writer;
  }

  /**
   * @throws {Error} if writing fails; {McapFileFull} if the file has reached its maximum size, as all these methods do
   */
  async addCloud(record: CloudRecord): Promise<void> {
    const ns = this.#nsOf(record.capturedAtMs);
    const kind: CloudKind = record.type === 'sent' ? 'sent' : 'captured';
    this.dropped[kind] = record.dropped;
    this.#newestNs = ns;
    let cloud: Uint8Array[];
    try {
      cloud = this.#cloudOf(record, ns);
    } catch {
      // A cloud that cannot be decoded is no reason to lose the rest.
      this.faults++;
      return;
    }
    // One capture may arrive twice, as captured and as sent.
    if (ns !== this.#lastTransformNs) {
      this.#lastTransformNs = ns;
      await this.#addTransform(ns, CAMERA_FRAME, record.pose);
    }
    await this.#add(kind, record.sequence, ns, cloud);
  }

  /** Creates a topic for each camera, even for those whose pictures nobody will look at. */
  addCameras(cameras: readonly RecordedCamera[]): void {
    const name = 'foxglove_msgs/msg/CompressedImage';
    const schema = { name, encoding: 'ros2msg' as const, text: FOXGLOVE_COMPRESSED_IMAGE_SCHEMA };
    const topics = pictureTopics(cameras.map((camera) => camera.name));
    this.#cameras = cameras.map(({ name: camera, ofCloud }, i) => ({
      channel: this.file.addChannel({
        ...{ topic: topics[i] as string, messageEncoding: 'cdr', schema, metadata: { camera } },
      }),
      // The positions of the other cameras are unknown.
      frame: ofCloud ? CAMERA_FRAME : camera,
    }));
  }

  /** @throws {Error} if writing fails */
  async addPicture({
    camera,
    capturedAtMs,
    sequence,
    dropped,
    format,
    file,
  }: Omit<PictureRecord, 'type'>): Promise<void> {
    this.dropped.pictures = dropped;
    const of = this.#cameras[camera];
    if (of === undefined) {
      this.faults++;
      return;
    }
    const ns = this.#nsOf(capturedAtMs);
    await this.file.add(of.channel, sequence32Of(sequence), ns, [
      compressedImage(ns, of.frame, format, file),
    ]);
  }

  /** Creates a topic for each video, even for those that nobody will watch. */
  addVideos(videos: readonly RecordedVideo[]): void {
    const name = 'foxglove_msgs/msg/CompressedVideo';
    const schema = { name, encoding: 'ros2msg' as const, text: FOXGLOVE_COMPRESSED_VIDEO_SCHEMA };
    const topics = videoTopics(videos.map((video) => video.name));
    this.#videos = videos.map(({ name: camera, format }, i) => ({
      channel: this.file.addChannel({
        ...{ topic: topics[i] as string, messageEncoding: 'cdr', schema, metadata: { camera, format } },
      }),
      frame: camera,
      format,
    }));
  }

  /** @throws {Error} if writing fails */
  async addVideo({
    video,
    capturedAtMs,
    sequence,
    dropped,
    bytes,
  }: Omit<VideoRecord, 'type'>): Promise<void> {
    this.dropped.videos = dropped;
    const of = this.#videos[video];
    if (of === undefined) {
      this.faults++;
      return;
    }
    const ns = this.#nsOf(capturedAtMs);
    await this.file.add(of.channel, sequence32Of(sequence), ns, [
      compressedVideo(ns, of.frame, of.format, bytes),
    ]);
  }

  /** @throws {Error} if writing fails */
  async addEvent(record: EventRecord): Promise<void> {
    const ns = this.#nsOf(record.timeMs);
    this.#newestNs = ns;
    const { sequence } = record;
    switch (record.type) {
      case 'json':
        await this.addJson(record.kind, sequence, ns, record.value);
        break;
      case 'velocity':
        await this.#add('velocity', sequence, ns, [twistStamped(ns, record.twist)]);
        break;
      case 'state':
        // Viewers place frames only by tf: without this transform, data in base_link would have no position.
        await this.#addTransform(ns, BASE_FRAME, record.pose);
        await this.#add('odometry', sequence, ns, [odometryOf(ns, record.pose, record.twist)]);
        break;
    }
  }

  /** Writes the state of the recording so far into the recording. */
  async addOwnState(): Promise<void> {
    const { messages, bytes } = this.file;
    const value = { messages, bytes, faults: this.faults, dropped: this.dropped };
    await this.addJson('recorder', this.#ownStates++, this.#newestNs, value);
  }

  addJson(kind: JsonKind, sequence: number, ns: bigint, value: object): Promise<void> {
    return this.#add(kind, sequence, ns, [new TextEncoder().encode(JSON.stringify(value))]);
  }

  /** Adds the pose of a frame in the world. */
  #addTransform(ns: bigint, frame: string, pose: Pose): Promise<void> {
    return this.#add('tf', this.#transforms++, ns, [transformOf(ns, frame, pose)]);
  }

  #add(kind: RosKind | JsonKind, sequence: number, ns: bigint, data: readonly Uint8Array[]): Promise<void> {
    return this.file.add(this.#channels.get(kind) as number, sequence32Of(sequence), ns, data);
  }

  #cloudOf(record: CloudRecord, ns: bigint): Uint8Array[] {
    if (record.type === 'sent') {
      const words = this.#decoder.decode(record);
      const points = new Uint8Array(words.buffer, words.byteOffset, words.byteLength);
      return pointCloud2(ns, words.length / 4, 1, points);
    }
    const points = recordedPoints(record, this.#room);
    const count = points.length / 16;
    const isGrid = record.width * record.height === count;
    return pointCloud2(ns, isGrid ? record.width : count, isGrid ? record.height : 1, points);
  }

  #nsOf(ms: number): bigint {
    return this.#epochNs + BigInt(Math.round(ms * 1000)) * 1000n;
  }
}
