import type { RateController } from '@farpoint/congestion';
import type { IceCandidate, Sound, StageTimings, StreamStatus, VideoCodec } from '@farpoint/protocol';
import type { CandidateRefusal } from '@farpoint/webrtc';
import type { Budgets } from '../../send/budgets/budgets.ts';
import type { CloudClaim } from '../../send/budgets/cloud-shares.ts';
import type { PathBudget } from '../../send/budgets/path-budget.ts';
import { FrameReceiver } from '../../send/clouds/frame-receiver.ts';
import { droppedFrames, StreamMeter } from '../../send/clouds/stream-meter.ts';
import type { WantedClouds } from '../../send/clouds/wanted-clouds.ts';
import { PictureSender } from '../../send/pictures/picture-sender.ts';
import { OperatorSound } from '../../send/sound/operator-sound.ts';
import type { AnswerVerdict } from '../../send/transport/answer-gate.ts';
import { OperatorPeer } from '../../send/transport/operator-peer.ts';
import type { PacketLog } from '../../send/transport/packet-log.ts';
import type {
  OperatorPeerEvents,
  OperatorPeerOptions,
  PeerEnd,
  SoundLine,
  VideoLine,
} from '../../send/transport/peer-events.ts';
import type { RtpTransport } from '../../send/transport/rtp-transport.ts';
import type { SendLoop } from '../../send/transport/send-loop.ts';
import { SharedFrame } from '../../send/transport/shared-frame.ts';
import { StreamSender } from '../../send/transport/stream-sender.ts';
import { OperatorVideos } from '../../send/video/operator-videos.ts';
import type { CodedStream } from '../../sense/encode/coded-frame-encoder.ts';
import { slotSequenceOffset } from '../../sense/encode/packetiser.ts';
import type { ReadyPicture } from '../../sense/pictures/picture-messages.ts';
import { SOUND_STREAM } from '../../sense/sound/sound-frame.ts';
import type { VideoFrame } from '../../sense/video/video-frame.ts';
import { type LatencyTest, LatencyTests } from './latency-tests.ts';
import { OperatorMessages, type SessionHost } from './operator-messages.ts';
import type { WishesListener } from './operator-wishes.ts';
import { RestartPolicy } from './restart-policy.ts';
import { ResumeKey } from './resume-key.ts';

export interface OperatorSessionOptions {
  /** The session's handle, by which the guard also knows the operator. */
  session: string;
  operatorName: string;
  peer: OperatorPeerOptions;
  /** Makes the connection; default: over WebRTC. */
  openPeer?: ((options: OperatorPeerOptions, events: OperatorPeerEvents) => OperatorPeer) | undefined;
  /** @param transportFeedback whether the operator sends transport-wide feedback */
  makeController: (transportFeedback: boolean) => RateController;
  packetLog?: PacketLog | undefined;
  /** The largest share of the path that pictures may take, 0–1. */
  pictureShare: number;
  /** What the robot's cloud sensors claim of a path, indexed by sensor number. */
  claims: () => readonly CloudClaim[];
  /** Told when streaming starts or pauses, or when its bit rate or formats may have changed. */
  budgets: Pick<Budgets, 'update'>;
  /** What a video may use at most, bit/s without headers; 0 while it has no pictures. */
  mostVideoBitsPerSecond: (video: number, codecs: ReadonlySet<VideoCodec>) => number;
}

export interface OperatorSessionEvents {
  onCandidate(candidate: IceCandidate): void;
  onCandidateRefused(reason: CandidateRefusal, detail: string): void;
  onConnected(): void;
  /** The operator has named the formats or sensors that it reads, and may need the streams' headers. */
  onCloudFormats(): void;
  /** The operator can continue with a video only from a key frame. */
  onNeedsKeyFrame(video: number): void;
  /** A latency test's green frame was dropped; another is needed. */
  onLatencyFrameLost(): void;
  onEnded(end: PeerEnd, detail: string): void;
}

export interface WishedParts {
  clouds: WantedClouds;
  videos: OperatorVideos;
  pictures: PictureSender;
  sound: OperatorSound;
  budget: PathBudget;
  /** Discards what is waiting to be sent. */
  clear(): void;
  budgets: OperatorSessionOptions['budgets'];
  events: Pick<OperatorSessionEvents, 'onCloudFormats'>;
}

/** Hands what an operator wants of the streams to the session's parts. */
function wishesListener(parts: WishedParts): WishesListener {
  const { clouds, videos, pictures, sound, budget, budgets, events } = parts;
  /** The operator's part of the path changes, or what it makes of it. */
  const budgeted =
    <Wish extends unknown[]>(take: (...wish: Wish) => void) =>
    (...wish: Wish): void => {
      take(...wish);
      budgets.update();
    };
  return {
    switchStream: budgeted((running) => {
      if (!running) parts.clear();
    }),
    wantSensors: budgeted((sensors) => {
      clouds.sensors = new Set(sensors);
      events.onCloudFormats();
    }),
    readFormats: budgeted((formats) => {
      clouds.formats = new Set(formats);
      events.onCloudFormats();
    }),
    fitDisplay: budgeted(({ framesPerSecond, points }) => {
      clouds.pace.display = { framesPerSecond, points };
    }),
    wantVideos: budgeted((wanted, barcode) => videos.want(wanted, barcode)),
    weigh: budgeted((shares) => budget.weigh(shares)),
    watchCameras: (cameras) => pictures.watch(cameras),
    listen: (on) => sound.listen(on),
    speak: (held) => sound.speak(held),
  };
}

/**
 * A page tells the capture time of a video's picture from its clock and the network's, ms. Chosen: above half
 * of what the two ways of a usual path differ by.
 */
const VIDEO_EXACT_MS = 50;

/** One operator: connection, session and stream. */
export class OperatorSession extends FrameReceiver {
  readonly messages: OperatorMessages;
  readonly peer: OperatorPeer;
  readonly restarts = new RestartPolicy();
  readonly resumeKey = new ResumeKey();
  /** Nothing has been heard from the operator for a while, so its points would be lost. */
  quiet = false;
  readonly #host: SessionHost;
  readonly #sendLoop: SendLoop;
  readonly #makeController: OperatorSessionOptions['makeController'];
  readonly #packetLog: PacketLog | undefined;
  readonly #events: OperatorSessionEvents;
  readonly #meter = new StreamMeter();
  readonly #budgets: OperatorSessionOptions['budgets'];
  readonly pictures: PictureSender;
  readonly videos: OperatorVideos;
  readonly sound: OperatorSound;
  readonly #tests = new LatencyTests();
  readonly #onViewSent = () => this.#host.drive.guard.onViewSent(this.id, this.#host.now());
  #pathHeardMs = 0;

  constructor(
    options: OperatorSessionOptions,
    host: SessionHost,
    sendLoop: SendLoop,
    events: OperatorSessionEvents,
  ) {
    super(options.claims, options.pictureShare);
    this.#host = host;
    this.#sendLoop = sendLoop;
    this.#events = events;
    this.#makeController = options.makeController;
    this.#packetLog = options.packetLog;
    this.#budgets = options.budgets;
    const { openPeer = (...given) => new OperatorPeer(...given) } = options;
    this.peer = openPeer(options.peer, {
      onCandidate: (candidate) => events.onCandidate(candidate),
      onCandidateRefused: (reason, detail) => events.onCandidateRefused(reason, detail),
      onConnected: (transport, videos, sound) => this.#onConnected(transport, videos, sound),
      onMessage: (channel, data) => this.messages.onMessage(channel, data),
      onPicturesLow: () => this.#sendPictures(),
      drives: () => host.drive.guard.leaseHolder === this.id,
      onEnded: (end, detail) => this.#onEnded(end, detail),
    });
    this.pictures = new PictureSender(this.peer, this.#onViewSent);
    this.videos = new OperatorVideos(this.budget, options.mostVideoBitsPerSecond, (video) =>
      events.onNeedsKeyFrame(video),
    );
    this.sound = new OperatorSound(this.budget, () => host.now());
    this.messages = new OperatorMessages(options.session, options.operatorName, host, this.peer);
    this.messages.onReceiverReport = (report) => this.sender?.onReceiverReport(report);
    this.messages.onReceiverLimit = (bitsPerSecond) => {
      this.sender?.onReceiverLimit(bitsPerSecond);
      options.budgets.update();
    };
    this.messages.wishes.listener = wishesListener({
      clouds: this.clouds,
      videos: this.videos,
      pictures: this.pictures,
      sound: this.sound,
      budget: this.budget,
      clear: () => this.#clear(),
      budgets: options.budgets,
      events,
    });
  }

  /** The operator's answer to our latest offer. Never throws. */
  async answer(sdp: string): Promise<AnswerVerdict> {
    const verdict = await this.peer.answer(sdp);
    if (verdict === 'taken') this.restarts.onAnswer();
    return verdict;
  }

  /** The name by which the guard knows the operator. */
  get id(): string {
    return this.messages.id;
  }

  /** Whether the operator is connected, not paused and not silent. */
  get streaming(): boolean {
    return this.sender !== null && this.messages.wishes.streaming && !this.quiet;
  }

  get operatorName(): string {
    return this.messages.operatorName;
  }

  tellSound(message: Sound): void {
    this.messages.send(message);
  }

  /** When the operator was last heard from (a message, RTCP or a connectivity check), ms on the robot's clock. */
  get heardMs(): number {
    return Math.max(this.messages.heardMs, this.sender?.heardMs ?? 0, this.#pathHeardMs);
  }

  get watchedCameras(): ReadonlySet<number> {
    return this.pictures.watched;
  }

  /** How much of the path pictures may take, bit/s on the wire; 0 while there is no path. */
  get pictureBitsPerSecond(): number {
    const { sender } = this;
    return sender === null ? 0 : this.budget.pictureBitsPerSecond(sender.targetBitsPerSecond);
  }

  get wantedVideos(): ReadonlySet<number> {
    return this.videos.wanted;
  }

  get wantsBarcode(): boolean {
    return this.videos.barcode;
  }

  readonly videoCodecs = (video: number) => this.videos.codecs(video);

  offerVideo(frame: VideoFrame): void {
    if (!this.streaming) return;
    if (this.videos.wanted.has(frame.video)) this.#mayBeSeen(frame.capturedAtMs, VIDEO_EXACT_MS);
    this.videos.offer(frame);
  }

  offerPicture(picture: ReadyPicture): void {
    if (!this.streaming) return;
    if (this.pictures.watched.has(picture.header.camera)) this.#mayBeSeen(picture.capturedAtMs);
    this.pictures.offer(picture);
  }

  get droppedFrames(): number {
    return droppedFrames(this.sender);
  }

  /** @returns false if the test is already known */
  askLatencyTest(test: LatencyTest): boolean {
    return this.#tests.ask(test);
  }

  /** Queues a frame for the pacer. A green frame answers the waiting latency tests. */
  enqueue(shared: SharedFrame): void {
    if (this.sender === null || !this.streaming) return;
    const { frame } = shared;
    const { frameNumber, points, capturedAtMs } = frame;
    if (!frame.latencyTest && !this.clouds.pace.takes(frame.sensor, capturedAtMs)) return;
    for (const { id, commandMs } of this.#tests.answeredBy(shared)) {
      const moments = { commandMs, captureMs: capturedAtMs };
      this.messages.send({ type: 'latencyFrame', id, frameNumber, points, ...moments });
    }
    this.#meter.onQueued(shared);
    this.#mayBeSeen(capturedAtMs);
    this.sender.enqueue(shared);
  }

  override announce({ format, header }: CodedStream, sensor: number): void {
    const text = Buffer.from(header).toString('base64');
    this.messages.send({ type: 'cloudStream', format, header: text, ...(sensor === 0 ? {} : { sensor }) });
  }

  /** Updates the budget, and sends what is due. Call every 25 ms. */
  update(): void {
    if (this.peer.heardSinceLast()) this.#pathHeardMs = this.#host.now();
    this.budget.update(this.peer.messageBytesSent, this.pictures.bytesSent, this.#host.now());
    this.#sendPictures();
    this.videos.sendDueReports(this.#host.now());
    this.sender?.update();
    this.messages.flushRejections();
  }

  /** This operator's stream for telemetry. Call once per telemetry message: rates count from the previous call. */
  status(captureStages: StageTimings, nowMs: number): { stages: StageTimings; stream: StreamStatus } {
    return this.#meter.status(captureStages, this.sender, nowMs);
  }

  #mayBeSeen(capturedAtMs: number, exactMs = 0): void {
    this.#host.drive.guard.sentViews.sent(this.id, capturedAtMs, exactMs);
  }

  /** Of a frame that was cut short, the part that has left counts. */
  #noteStages(shared: SharedFrame, sender: StreamSender): void {
    const departure = sender.departureOf(shared);
    if (departure === null) return;
    const { frame } = shared;
    const { sensor, frameNumber, capturedAtMs, inMemoryMs, readyMs } = frame;
    const { firstMs: firstLeftMs, lastMs: lastLeftMs } = departure;
    const at = { capturedAtMs, inMemoryMs, readyMs, firstLeftMs, lastLeftMs };
    this.messages.stages.frame(sensor, frameNumber, at);
    this.#host.frameTimed?.(this.messages, frame, at);
  }

  #sendPictures(): void {
    this.pictures.sendDue(this.#host.now(), this.streaming ? this.pictureBitsPerSecond : 0);
  }

  /** Discards what is waiting to be sent. */
  #clear(): void {
    this.sender?.clear();
    this.pictures.clear();
    this.videos.clear();
  }

  #onConnected(transport: RtpTransport, lines: readonly VideoLine[], sound: SoundLine | null): void {
    const now = () => this.#host.now();
    const sender = new StreamSender(transport, this.#makeController(transport.transportFeedback), now);
    const log = this.#packetLog;
    if (log !== undefined) {
      sender.onPacketSent = (frame, index, sentMs) => {
        if (frame instanceof SharedFrame)
          log.add(frame.frame.frameNumber, slotSequenceOffset(frame.slots, index), sentMs);
      };
    }
    sender.onFrameSent = ({ frame, sendMs }) => {
      if (frame.stream !== SOUND_STREAM) this.#onViewSent();
      if (!(frame instanceof SharedFrame)) return;
      this.#meter.onSent(frame, sendMs);
      this.#noteStages(frame, sender);
      this.#tests.onSent(frame);
    };
    sender.onFrameDropped = (frame) => {
      // A packet of sound is needed by no other.
      if (frame.stream === SOUND_STREAM) return;
      if (!(frame instanceof SharedFrame)) {
        this.videos.onDropped(frame.stream);
        return;
      }
      this.#noteStages(frame, sender);
      if (this.#tests.onLost(frame)) this.#events.onLatencyFrameLost();
    };
    this.videos.connect(sender, lines);
    this.sound.connect(sender, sound);
    sender.onRateChanged = () => {
      this.#budgets.update();
      this.#sendLoop.run();
    };
    this.messages.heardMs = this.#host.now();
    this.sender = sender;
    this.#sendLoop.add(sender);
    this.#events.onConnected();
  }

  #onEnded(end: PeerEnd, detail: string): void {
    const sender = this.sender;
    this.sender = null;
    this.#tests.clear();
    this.pictures.clear();
    this.videos.disconnect();
    this.sound.disconnect();
    if (sender !== null) {
      this.#sendLoop.remove(sender);
      sender.clear();
    }
    this.#events.onEnded(end, detail);
  }
}
