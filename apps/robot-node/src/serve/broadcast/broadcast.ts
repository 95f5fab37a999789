import { FixedRateController } from '@farpoint/congestion';
import type { MountpointMedia } from '@farpoint/janus';
import type { VideoCodec, VideoDescription } from '@farpoint/protocol';
import { FMT_FULL_INTRA, FMT_PICTURE_LOSS, RTCP_PAYLOAD_FEEDBACK, walkRtcp } from '@farpoint/rtp';
import type { Logger } from '@farpoint/service';
import type { Budgets } from '../../send/budgets/budgets.ts';
import type { CloudClaim } from '../../send/budgets/cloud-shares.ts';
import { FrameReceiver } from '../../send/clouds/frame-receiver.ts';
import type { SendLoop } from '../../send/transport/send-loop.ts';
import type { SharedFrame } from '../../send/transport/shared-frame.ts';
import { StreamSender } from '../../send/transport/stream-sender.ts';
import { VideoSender } from '../../send/video/video-sender.ts';
import type { CodedStream } from '../../sense/encode/coded-frame-encoder.ts';
import { CODED_FORMATS } from '../../sense/encode/plan.ts';
import { streamOfVideo, type VideoFrame, videoOfStream } from '../../sense/video/video-frame.ts';
import type { VideoTarget } from '../../sense/video/video-hub.ts';
import { asBroadcast, type CloudHeader, describeBroadcast } from './broadcast-description.ts';
import { broadcastMedia, midOfVideo } from './broadcast-media.ts';
import type { BroadcastOptions } from './broadcast-options.ts';
import { BroadcastSockets } from './broadcast-sockets.ts';
import { BroadcastTransport } from './broadcast-transport.ts';
import { KeyFrameGate } from './key-frame-gate.ts';
import { type Mountpoint, MountpointKeeper } from './mountpoint-keeper.ts';
import { StampedVideoFrame } from './stamped-video-frame.ts';

export interface BroadcastParts {
  options: BroadcastOptions;
  /** The robot's name, for people. */
  name: string;
  codecs: readonly VideoCodec[];
  /** Of the sensors whose clouds are broadcast. */
  sensors: readonly { name: string }[];
  claims: () => readonly CloudClaim[];
  /** What viewers are told of each video, besides its m-line. */
  videos: () => readonly Omit<VideoDescription, 'mid'>[];
  mostVideoBitsPerSecond: (video: number, codecs: ReadonlySet<VideoCodec>) => number;
  sendLoop: SendLoop;
  requestKeyFrame: (video: number) => void;
  budgets: Pick<Budgets, 'update'>;
  /** The coded streams' headers are needed. */
  onStart: () => void;
  now: () => number;
  log: Logger;
}

/** Everything that belongs to one mountpoint. */
interface Feed {
  sockets: BroadcastSockets;
  /** By m-line. */
  transports: readonly BroadcastTransport[];
  sender: StreamSender;
  videos: VideoSender;
}

/**
 * How often Janus is shown where its RTCP is to be sent, ms. Chosen: a Janus that has forgotten it gets no
 * reports for a second, and a packet costs 12 bytes.
 */
const KNOCK_MS = 1000;
/**
 * So long after the last sign of life, Janus is not fed any more, ms. Chosen: ten questions without an answer
 * (mountpoint-keeper.ts).
 */
const SILENCE_MS = 10_000;

/**
 * Feeds a relay with videos and clouds, once for any number of viewers, and only while somebody watches. To the robot it
 * is one more operator that sees everything and drives nothing.
 */
export class Broadcast extends FrameReceiver implements VideoTarget {
  readonly id = 'broadcast';
  readonly wantsBarcode = false;
  readonly keyFrames: KeyFrameGate;
  readonly keeper: MountpointKeeper;
  viewers = 0;
  readonly #parts: BroadcastParts;
  readonly #media: readonly MountpointMedia[];
  /** Of each video the codec that its m-line has. */
  readonly #codecs: ReadonlyMap<number, ReadonlySet<VideoCodec>>;
  readonly #videos: readonly number[];
  /** By sensor and format. */
  readonly #streams = new Map<string, CloudHeader>();
  #feed: Feed | null = null;
  #heardMs = Number.NEGATIVE_INFINITY;
  #knockedMs = Number.NEGATIVE_INFINITY;
  #wasStreaming = false;
  /** Of earlier feeds. */
  #bytesBefore = 0;

  constructor(parts: BroadcastParts) {
    super(parts.claims);
    this.#parts = parts;
    const { options, codecs, sensors, log, name } = parts;
    this.#media = broadcastMedia(codecs, options.clouds);
    this.clouds.sensors = new Set(options.clouds ? sensors.keys() : []);
    // Viewers that cannot read a format see nothing of it, but the page that comes with the robot reads all.
    this.clouds.formats = new Set(CODED_FORMATS);
    this.#codecs = new Map(codecs.map((codec, video) => [video, new Set([codec])]));
    this.#videos = [...codecs.keys()];
    this.keyFrames = new KeyFrameGate(options.keyFrameMs);
    this.budget.wantVideos(
      () =>
        new Map(
          this.#videos.map((video) => [video, parts.mostVideoBitsPerSecond(video, this.videoCodecs(video))]),
        ),
    );
    this.keeper = new MountpointKeeper(
      { options, name, media: this.#media, metadata: () => this.#description(), log },
      {
        onMountpoint: (mountpoint) => this.#onMountpoint(mountpoint),
        onFoundAgain: () => {
          for (const transport of this.#feed?.transports ?? []) transport.renew();
          for (const video of this.#videos) this.#needsKeyFrame(video);
        },
        onViewers: (viewers) => this.#onViewers(viewers),
      },
    );
  }

  start(): void {
    this.keeper.start();
  }

  /** Bytes sent so far, all headers counted. */
  get bytesSent(): number {
    return this.#bytesBefore + (this.#feed?.sender.counters.bytesSent ?? 0);
  }

  get up(): boolean {
    return this.#feed !== null && this.#parts.now() - this.#heardMs < SILENCE_MS;
  }

  get streaming(): boolean {
    return this.up && this.viewers > 0;
  }

  /** Datagrams that could not be sent to the present mountpoint. */
  get failures(): number {
    return this.#feed?.sockets.failures ?? 0;
  }

  get wantedVideos(): ReadonlySet<number> {
    return this.#feed?.videos.wanted ?? new Set();
  }

  readonly videoCodecs = (video: number) => this.#codecs.get(video) ?? new Set<VideoCodec>();

  /** Without feedback there is no probing. */
  override probesWith(): boolean {
    return false;
  }

  enqueue(shared: SharedFrame): void {
    if (this.streaming) this.#feed?.sender.enqueue(shared);
  }

  offerVideo(frame: VideoFrame): void {
    if (!this.streaming) return;
    if (frame.key) this.keyFrames.onKeyFrame(frame.video, this.#parts.now());
    this.#feed?.videos.offer(frame);
  }

  override announce({ format, header }: CodedStream, sensor: number): void {
    this.#streams.set(`${sensor} ${format}`, {
      format,
      header: Buffer.from(header).toString('base64'),
      sensor,
    });
    this.keeper.describe();
  }

  /** A video has stopped or returned. */
  videosChanged(): void {
    this.keeper.describe();
  }

  /** Follows whether anybody watches, and asks for due key frames. Call every 25 ms. */
  update(): void {
    const nowMs = this.#parts.now();
    const { streaming } = this;
    if (streaming !== this.#wasStreaming) this.#onSwitched(streaming);
    if (this.#feed === null) return;
    if (nowMs - this.#knockedMs >= KNOCK_MS) this.#knock(nowMs);
    if (!streaming) return;
    for (const video of this.keyFrames.due(nowMs)) this.#parts.requestKeyFrame(video);
    this.#feed.sender.update();
  }

  async close(): Promise<void> {
    this.#drop();
    await this.keeper.close();
  }

  #onSwitched(streaming: boolean): void {
    this.#wasStreaming = streaming;
    const { log, budgets, onStart } = this.#parts;
    log.info({ viewers: this.viewers, up: this.up }, streaming ? 'broadcast begins' : 'broadcast pauses');
    if (streaming) onStart();
    else {
      this.#feed?.sender.clear();
      this.#feed?.videos.clear();
    }
    budgets.update();
  }

  #onMountpoint({ address, ports, srtp }: Mountpoint): void {
    this.#drop();
    const { now, sendLoop, options } = this.#parts;
    const transports = this.#media.map(({ pt }) => new BroadcastTransport(pt, srtp));
    const sockets = new BroadcastSockets(address, ports, (stream, compound) =>
      this.#onRtcp(stream, compound),
    );
    for (const [stream, transport] of transports.entries()) transport.connect(sockets.sender(stream));
    // A sender has a stream of clouds; without clouds it leads nowhere.
    const cloud = options.clouds ? transports[0] : undefined;
    const rate = new FixedRateController({ bitsPerSecond: options.bitsPerSecond });
    const sender = new StreamSender(cloud ?? new BroadcastTransport(0, null), rate, now);
    for (const video of this.#videos)
      sender.addStream(streamOfVideo(video), transports[this.#lineOf(video)] as BroadcastTransport);
    const videos = new VideoSender(
      this.#codecs,
      (frame) => sender.enqueue(new StampedVideoFrame(frame)),
      (video) => this.#needsKeyFrame(video),
    );
    sender.onFrameDropped = ({ stream }) => {
      if (stream > 0) videos.onDropped(videoOfStream(stream));
    };
    this.#feed = { sockets, transports, sender, videos };
    this.sender = sender;
    sendLoop.add(sender);
    videos.want(this.#videos);
    this.#knock(now());
  }

  #drop(): void {
    const feed = this.#feed;
    if (feed === null) return;
    this.#feed = null;
    this.sender = null;
    this.viewers = 0;
    this.#bytesBefore += feed.sender.counters.bytesSent;
    this.#parts.sendLoop.remove(feed.sender);
    feed.sender.clear();
    feed.sockets.close();
  }

  #onViewers(viewers: number): void {
    this.#heardMs = this.#parts.now();
    this.viewers = viewers;
  }

  /** Only requests for key frames count: the relay gives no other feedback that holds for all viewers. */
  #onRtcp(line: number, compound: Uint8Array): void {
    const video = this.#videos.find((each) => this.#lineOf(each) === line);
    if (video === undefined) return;
    for (const { packetType, format } of walkRtcp(compound, () => undefined)) {
      if (packetType !== RTCP_PAYLOAD_FEEDBACK) continue;
      if (format === FMT_PICTURE_LOSS || format === FMT_FULL_INTRA) this.#feed?.videos.onPictureLoss(video);
    }
  }

  #needsKeyFrame(video: number): void {
    if (this.keyFrames.request(video, this.#parts.now())) this.#parts.requestKeyFrame(video);
  }

  #knock(nowMs: number): void {
    this.#knockedMs = nowMs;
    for (const [line, transport] of (this.#feed?.transports ?? []).entries())
      this.#feed?.sockets.knock(line, transport.knock());
  }

  /** The video's m-line. */
  #lineOf(video: number): number {
    return this.#media.findIndex(({ mid }) => mid === midOfVideo(video));
  }

  #description(): string {
    const { name, videos, codecs, sensors, options } = this.#parts;
    return describeBroadcast(name, asBroadcast(videos(), codecs), options.clouds ? sensors : [], [
      ...this.#streams.values(),
    ]);
  }
}
