import type { LiveServer } from '@farpoint/foxglove';
import type { Pose } from '@farpoint/protocol';
import { PointRoom, recordedPoints } from './captured-cloud.ts';
import { McapFileWriter } from './mcap-file-writer.ts';
import { MessageOutputs } from './message-outputs.ts';
import {
  type CloudKind,
  type CloudRecord,
  type EventKind,
  type EventRecord,
  JSON_TOPICS,
  type JsonKind,
  type LiveWishes,
  type PictureRecord,
  type RecordedAlarm,
  type RecordedCamera,
  type RecordedQuantity,
  type RecordedVideo,
  type RecorderOptions,
  type VideoRecord,
} from './recorder-messages.ts';
import {
  FOXGLOVE_COMPRESSED_IMAGE_SCHEMA,
  FOXGLOVE_COMPRESSED_VIDEO_SCHEMA,
  FOXGLOVE_LOG_SCHEMA,
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
  logLine,
  odometryOf,
  pointCloud2,
  transformOf,
  twistStamped,
} from './ros-writer.ts';
import type { SentCloudDecoder } from './sent-cloud.ts';
import { TelemetryChannels } from './telemetry-channels.ts';
import { pictureTopics, videoTopics } from './topic-names.ts';

const ROS_TOPICS = {
  captured: ['/farpoint/captured', 'sensor_msgs/msg/PointCloud2', POINT_CLOUD2_SCHEMA],
  sent: ['/farpoint/sent', 'sensor_msgs/msg/PointCloud2', POINT_CLOUD2_SCHEMA],
  tf: ['/tf', 'tf2_msgs/msg/TFMessage', TF_MESSAGE_SCHEMA],
  velocity: ['/farpoint/cmd_vel', 'geometry_msgs/msg/TwistStamped', TWIST_STAMPED_SCHEMA],
  odometry: ['/odom', 'nav_msgs/msg/Odometry', ODOMETRY_SCHEMA],
  bookmark: ['/farpoint/bookmarks', 'foxglove_msgs/msg/Log', FOXGLOVE_LOG_SCHEMA],
} as const;
type RosKind = keyof typeof ROS_TOPICS;

/**
 * Converts the messages of a robot's threads to messages of an MCAP file and of live viewers. Wait for each call before
 * the next.
 */
export class RecordingWriter {
  /** Records that could not be converted to messages. */
  faults = 0;
  /** Clouds, pictures and frames of videos that never arrived here because the writer did not keep up. */
  readonly dropped: Record<CloudKind | 'pictures' | 'videos', number> = {
    captured: 0,
    sent: 0,
    pictures: 0,
    videos: 0,
  };
  readonly out: MessageOutputs;
  readonly #options: RecorderOptions;
  readonly #decoder: SentCloudDecoder;
  readonly #channels = new Map<RosKind | JsonKind, number>();
  #cameras: { channel: number; frame: string }[] = [];
  #videos: { channel: number; frame: string }[] = [];
  /** Its content is written, or copied, before the next cloud. */
  readonly #room = new PointRoom();
  readonly #telemetry: TelemetryChannels;
  #transforms = 0;
  #ownStates = 0;
  #newestNs = 0n;
  #lastTransformNs = 0n;

  private constructor(out: MessageOutputs, options: RecorderOptions, decoder: SentCloudDecoder) {
    this.out = out;
    this.#options = options;
    this.#decoder = decoder;
    this.#telemetry = new TelemetryChannels(out, (ms) => this.#nsOf(ms));
    for (const [kind, [topic, name, text]] of Object.entries(ROS_TOPICS)) {
      const schema = { name, encoding: 'ros2msg' as const, text };
      this.#channels.set(kind as RosKind, out.addChannel({ topic, messageEncoding: 'cdr', schema }));
    }
    for (const [kind, topic] of Object.entries(JSON_TOPICS)) {
      this.#channels.set(kind as JsonKind, out.addChannel({ topic, messageEncoding: 'json', schema: null }));
    }
  }

  /** @throws {Error} if the file already exists or cannot be created */
  static async create(
    options: RecorderOptions,
    live: LiveServer | null,
    decoder: SentCloudDecoder,
  ): Promise<RecordingWriter> {
    const writer = new RecordingWriter(new MessageOutputs(null, live), options, decoder);
    if (options.path !== null) await writer.openFile(options.path);
    return writer;
  }

  /** Begins a file. The one before must be closed. @throws {Error} if it already exists or cannot be created */
  async openFile(path: string): Promise<void> {
    const { compression, mostBytes, epochNs, robotId } = this.#options;
    const file = await McapFileWriter.create(path, compression, 'farpoint', mostBytes);
    this.out.openFile(file);
    await file.addMetadata('farpoint', { robot: robotId, epochNs: String(epochNs) });
  }

  /** What live viewers subscribe to. */
  get liveWishes(): LiveWishes {
    const wants = (kind: RosKind | JsonKind) => this.out.wantsLive(this.#channels.get(kind) as number);
    const wanted = (of: readonly { channel: number }[]) =>
      of.flatMap(({ channel }, i) => (this.out.wantsLive(channel) ? [i] : []));
    const events: EventKind[] = (Object.keys(JSON_TOPICS) as JsonKind[]).filter(wants);
    if (wants('velocity')) events.push('velocity');
    if (wants('tf') || wants('odometry')) events.push('state');
    if (wants('bookmark')) events.push('bookmark');
    events.push(...this.#telemetry.liveWishes);
    return {
      clouds: { captured: wants('captured'), sent: wants('sent') },
      pictures: wanted(this.#cameras),
      videos: wanted(this.#videos),
      events,
    };
  }

  /** @returns the video that live viewers know as this channel; -1 if it is another */
  videoOfLive(id: number): number {
    const channel = this.out.channelOfLive(id);
    return this.#videos.findIndex((video) => video.channel === channel);
  }

  /**
   * @throws {Error} if writing fails; {McapFileFull} if the file has reached its maximum size, as all these methods do
   */
  async addCloud(record: CloudRecord): Promise<void> {
    const ns = this.#nsOf(record.capturedAtMs);
    const kind: CloudKind = record.type === 'sent' ? 'sent' : 'captured';
    this.dropped[kind] = record.dropped;
    this.#newestNs = ns;
    const { to } = record;
    if (!this.out.wants(this.#channels.get(kind) as number, to)) return;
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
    await this.out.add(this.#channels.get(kind) as number, record.sequence, ns, cloud, { to });
  }

  /** Creates a topic for each camera, even for those whose pictures nobody will look at. */
  addCameras(cameras: readonly RecordedCamera[]): void {
    const name = 'foxglove_msgs/msg/CompressedImage';
    const schema = { name, encoding: 'ros2msg' as const, text: FOXGLOVE_COMPRESSED_IMAGE_SCHEMA };
    const topics = pictureTopics(cameras.map((camera) => camera.name));
    this.#cameras = cameras.map(({ name: camera, ofCloud }, i) => ({
      channel: this.out.addChannel({
        topic: topics[i] as string,
        messageEncoding: 'cdr',
        schema,
        metadata: { camera },
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
    if (!this.out.wants(of.channel)) return;
    const ns = this.#nsOf(capturedAtMs);
    await this.out.add(of.channel, sequence, ns, [compressedImage(ns, of.frame, format, file)]);
  }

  /** Creates a topic for each video, even for those that nobody will watch. */
  addVideos(videos: readonly RecordedVideo[]): void {
    const name = 'foxglove_msgs/msg/CompressedVideo';
    const schema = { name, encoding: 'ros2msg' as const, text: FOXGLOVE_COMPRESSED_VIDEO_SCHEMA };
    const topics = videoTopics(videos.map((video) => video.name));
    this.#videos = videos.map(({ name: camera, format }, i) => ({
      channel: this.out.addChannel({
        topic: topics[i] as string,
        messageEncoding: 'cdr',
        schema,
        metadata: { camera, format },
      }),
      frame: camera,
    }));
  }

  /** @throws {Error} if writing fails */
  async addVideo(record: Omit<VideoRecord, 'type'>): Promise<void> {
    const { video, capturedAtMs, key, format, sequence, dropped, to, bytes } = record;
    this.dropped.videos = dropped;
    const of = this.#videos[video];
    if (of === undefined) {
      this.faults++;
      return;
    }
    if (!this.out.wants(of.channel, to)) return;
    const ns = this.#nsOf(capturedAtMs);
    const link = key ? 'key' : 'follows';
    const message = compressedVideo(ns, of.frame, format, bytes);
    await this.out.add(of.channel, sequence, ns, [message], { to, link });
  }

  /** Creates a topic for each quantity and each alarm. */
  addTelemetry(quantities: readonly RecordedQuantity[], alarms: readonly RecordedAlarm[]): void {
    this.#telemetry.describe(quantities, alarms);
  }

  /** Creates a topic for the reports of the robot's components. @param topic where the robot has them from */
  addComponents(topic: string): void {
    this.#telemetry.addComponents(topic);
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
        await this.#add('velocity', sequence, ns, () => twistStamped(ns, record.twist));
        break;
      case 'bookmark':
        await this.#add('bookmark', sequence, ns, () => logLine(ns, record.by, record.text));
        break;
      case 'state':
        // Viewers place frames only by tf: without this transform, data in base_link would have no position.
        await this.#addTransform(ns, BASE_FRAME, record.pose);
        await this.#add('odometry', sequence, ns, () => odometryOf(ns, record.pose, record.twist));
        break;
      default:
        if (!(await this.#telemetry.add(record, ns))) this.faults++;
    }
  }

  /** Writes the state of the recording so far into the recording. */
  async addOwnState(): Promise<void> {
    if (!this.out.fileOpen) return;
    const { messages, bytes } = this.out;
    const value = { messages, bytes, faults: this.faults, dropped: this.dropped };
    await this.addJson('recorder', this.#ownStates++, this.#newestNs, value);
  }

  addJson(kind: JsonKind, sequence: number, ns: bigint, value: object): Promise<void> {
    return this.#add(kind, sequence, ns, () => new TextEncoder().encode(JSON.stringify(value)));
  }

  /** Adds the pose of a frame in the world. */
  #addTransform(ns: bigint, frame: string, pose: Pose): Promise<void> {
    return this.#add('tf', this.#transforms++, ns, () => transformOf(ns, frame, pose));
  }

  /** @param make is called only if anybody wants the message */
  async #add(kind: RosKind | JsonKind, sequence: number, ns: bigint, make: () => Uint8Array): Promise<void> {
    const channel = this.#channels.get(kind) as number;
    if (this.out.wants(channel)) await this.out.add(channel, sequence, ns, [make()]);
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
    return this.#options.epochNs + BigInt(Math.round(ms * 1000)) * 1000n;
  }
}
