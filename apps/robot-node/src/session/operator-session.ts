import type { RateController } from '@farpoint/congestion';
import type { CloudFormat, IceCandidate, StageTimings, StreamStatus } from '@farpoint/protocol';
import { BitRate, RateMeter } from '@farpoint/timing';
import type { CandidateRefusal } from '@farpoint/webrtc';
import type { CodedStream } from '../encode/coded-frame-encoder.ts';
import type { CodedFormat } from '../encode/plan.ts';
import type { ReadyPicture } from '../pictures/picture-messages.ts';
import { PictureSender } from '../pictures/picture-sender.ts';
import { type CloudClaim, cloudShare, probingSensor } from '../sensors/cloud-shares.ts';
import { StageTimer } from '../telemetry/stage-timer.ts';
import type { AnswerVerdict } from '../transport/answer-gate.ts';
import type { CloudTransport } from '../transport/cloud-transport.ts';
import { OperatorPeer } from '../transport/operator-peer.ts';
import type { PacketLog } from '../transport/packet-log.ts';
import type { OperatorPeerOptions, PeerEnd } from '../transport/peer-events.ts';
import type { SendLoop } from '../transport/send-loop.ts';
import type { SharedFrame } from '../transport/shared-frame.ts';
import { StreamSender } from '../transport/stream-sender.ts';
import type { FrameTarget } from './frame-fan-out.ts';
import { type LatencyTest, LatencyTests } from './latency-tests.ts';
import { OperatorMessages, type SessionHost } from './operator-messages.ts';
import { PathBudget } from './path-budget.ts';
import { RestartPolicy } from './restart-policy.ts';
import { ResumeKey } from './resume-key.ts';

export interface OperatorSessionOptions {
  /** The session's handle, by which the guard also knows the operator. */
  session: string;
  operatorName: string;
  peer: OperatorPeerOptions;
  /** @param transportFeedback whether the operator sends transport-wide feedback */
  makeController: (transportFeedback: boolean) => RateController;
  packetLog?: PacketLog | undefined;
  /** The largest share of the path that pictures may take, 0–1. */
  pictureShare: number;
  /** What the robot's cloud sensors claim of a path, indexed by sensor number. */
  claims: () => readonly CloudClaim[];
}

export interface OperatorSessionEvents {
  onCandidate(candidate: IceCandidate): void;
  onCandidateRefused(reason: CandidateRefusal, detail: string): void;
  onConnected(): void;
  /** Streaming started or paused, or its bit rate or formats may have changed. */
  onBudgetChanged(): void;
  /** The operator has named the formats or sensors that it reads, and may need the streams' headers. */
  onCloudFormats(): void;
  /** A latency test's green frame was dropped; another is needed. */
  onLatencyFrameLost(): void;
  onEnded(end: PeerEnd, detail: string): void;
}

/** One operator: connection, session and stream. */
export class OperatorSession implements FrameTarget {
  readonly messages: OperatorMessages;
  readonly peer: OperatorPeer;
  readonly restarts = new RestartPolicy();
  readonly resumeKey = new ResumeKey();
  sender: StreamSender | null = null;
  readonly #claims: OperatorSessionOptions['claims'];
  /** The sensors whose clouds the operator wants. */
  #sensors: ReadonlySet<number> = new Set([0]);
  /** The coded formats that the operator says it reads. */
  #formats: ReadonlySet<CloudFormat> = new Set();
  /** Nothing has been heard from the operator for a while, so its points would be lost. */
  quiet = false;
  readonly #host: SessionHost;
  readonly #sendLoop: SendLoop;
  readonly #makeController: OperatorSessionOptions['makeController'];
  readonly #packetLog: PacketLog | undefined;
  readonly #events: OperatorSessionEvents;
  readonly #frames = new RateMeter();
  readonly #points = new RateMeter();
  readonly #bytes = new RateMeter();
  readonly #stages = new StageTimer();
  readonly #budget: PathBudget;
  readonly pictures: PictureSender;
  readonly #tests = new LatencyTests();
  #pathHeardMs = 0;
  #framesSent = 0;
  #pointsSent = 0;
  #lastFrameNumber = 0;
  #lastValidPoints = 0;

  constructor(
    options: OperatorSessionOptions,
    host: SessionHost,
    sendLoop: SendLoop,
    events: OperatorSessionEvents,
  ) {
    this.#host = host;
    this.#sendLoop = sendLoop;
    this.#makeController = options.makeController;
    this.#packetLog = options.packetLog;
    this.#claims = options.claims;
    this.#budget = new PathBudget(options.pictureShare);
    this.#events = events;
    this.peer = new OperatorPeer(options.peer, {
      onCandidate: (candidate) => events.onCandidate(candidate),
      onCandidateRefused: (reason, detail) => events.onCandidateRefused(reason, detail),
      onConnected: (transport) => this.#onConnected(transport),
      onMessage: (channel, data) => this.messages.onMessage(channel, data),
      onPicturesLow: () => this.#sendPictures(),
      onEnded: (end, detail) => this.#onEnded(end, detail),
    });
    this.pictures = new PictureSender(this.peer);
    this.messages = new OperatorMessages(options.session, options.operatorName, host, this.peer);
    this.messages.onReceiverReport = (report) => this.sender?.onReceiverReport(report);
    this.messages.onReceiverLimit = (bitsPerSecond) => {
      this.sender?.onReceiverLimit(bitsPerSecond);
      events.onBudgetChanged();
    };
    this.messages.onStreamSwitch = (running) => {
      if (!running) this.#clear();
      events.onBudgetChanged();
    };
    this.messages.onSensors = (sensors) => {
      this.#sensors = new Set(sensors);
      events.onCloudFormats();
      events.onBudgetChanged();
    };
    this.messages.onPictures = (cameras) => this.pictures.watch(cameras);
    this.messages.onCloudFormats = (formats) => {
      this.#formats = new Set(formats);
      events.onCloudFormats();
      events.onBudgetChanged();
    };
  }

  /** The operator's answer to our latest offer. Never throws. */
  async answer(sdp: string): Promise<AnswerVerdict> {
    const verdict = await this.peer.answer(sdp);
    if (verdict === 'taken') this.restarts.onAnswer();
    return verdict;
  }

  /** Whether the operator reads this format. Formats are independent: reading one implies no other. */
  reads(format: CodedFormat): boolean {
    return this.#formats.has(format);
  }

  /** The name by which the guard knows the operator. */
  get id(): string {
    return this.messages.id;
  }

  /** Whether the operator is connected, not paused and not silent. */
  get streaming(): boolean {
    return this.sender !== null && this.messages.streaming && !this.quiet;
  }

  /** When the operator was last heard from (a message, RTCP or a connectivity check), ms on the robot's clock. */
  get heardMs(): number {
    return Math.max(this.messages.heardMs, this.sender?.heardMs ?? 0, this.#pathHeardMs);
  }

  wants(sensor: number): boolean {
    return this.#sensors.has(sensor);
  }

  probesWith(sensor: number): boolean {
    return probingSensor(this.#claims(), this.#sensors) === sensor;
  }

  /** How much of the path a sensor's points may take, bit/s on the wire; 0 while there is no path. */
  cloudBitsPerSecond(sensor: number): number {
    const { sender } = this;
    if (sender === null) return 0;
    const total = this.#budget.cloudBitsPerSecond(sender.targetBitsPerSecond) * sender.fit;
    return cloudShare(sensor, total, this.#claims(), this.#sensors);
  }

  get watchedCameras(): ReadonlySet<number> {
    return this.pictures.watched;
  }

  /** How much of the path pictures may take, bit/s on the wire; 0 while there is no path. */
  get pictureBitsPerSecond(): number {
    const { sender } = this;
    return sender === null ? 0 : this.#budget.pictureBitsPerSecond(sender.targetBitsPerSecond);
  }

  offerPicture(picture: ReadyPicture): void {
    if (this.streaming) this.pictures.offer(picture);
  }

  get droppedFrames(): number {
    const drops = this.sender?.droppedFrames;
    return drops === undefined ? 0 : drops.superseded + drops.overdue;
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
    for (const { id, commandMs } of this.#tests.answeredBy(shared)) {
      const moments = { commandMs, captureMs: capturedAtMs };
      this.messages.send({ type: 'latencyFrame', id, frameNumber, points, ...moments });
    }
    if (frame.sensor === 0) this.#lastValidPoints = frame.validPoints;
    this.sender.enqueue(shared);
  }

  announce({ format, header }: CodedStream, sensor: number): void {
    const text = Buffer.from(header).toString('base64');
    this.messages.send({ type: 'cloudStream', format, header: text, ...(sensor === 0 ? {} : { sensor }) });
  }

  /** Call every 25 ms. */
  tick(): void {
    if (this.peer.heardSinceLast()) this.#pathHeardMs = this.#host.now();
    this.#budget.update(this.peer.messageBytesSent, this.pictures.bytesSent, this.#host.now());
    this.#sendPictures();
    this.sender?.tick();
    this.messages.flushRejections();
  }

  /** This operator's stream for telemetry. Call once per telemetry message: rates count from the previous call. */
  status(captureStages: StageTimings, nowMs: number): { stages: StageTimings; stream: StreamStatus } {
    this.#frames.update(this.#framesSent, nowMs);
    this.#points.update(this.#pointsSent, nowMs);
    this.#bytes.update(this.sender?.counters.bytesSent ?? 0, nowMs);
    const framesPerSecond = this.#frames.perSecond;
    return {
      stages: { ...captureStages, sendMs: this.#stages.take().sendMs },
      stream: {
        frameNumber: this.#lastFrameNumber,
        framesPerSecond,
        pointsPerFrame: framesPerSecond > 0 ? this.#points.perSecond / framesPerSecond : 0,
        validPoints: this.#lastValidPoints,
        bitsPerSecond: BitRate.fromBytesPerSecond(this.#bytes.perSecond),
        targetBitsPerSecond: this.sender?.targetBitsPerSecond ?? 0,
        droppedFrames: this.droppedFrames,
        ...(this.sender?.transportFeedback === false ? { feedback: 'reports' as const } : {}),
      },
    };
  }

  /** For telemetry: called for frames of the first sensor only, whereas bytes count for all sensors. */
  #countSent({ frame }: SharedFrame): void {
    this.#lastFrameNumber = frame.frameNumber;
    this.#framesSent++;
    this.#pointsSent += frame.points;
  }

  #sendPictures(): void {
    this.pictures.tick(this.#host.now(), this.streaming ? this.pictureBitsPerSecond : 0);
  }

  /** Discards what is waiting to be sent. */
  #clear(): void {
    this.sender?.clear();
    this.pictures.clear();
  }

  #onConnected(transport: CloudTransport): void {
    const sender = new StreamSender(transport, this.#makeController(transport.transportFeedback), () =>
      this.#host.now(),
    );
    const log = this.#packetLog;
    if (log !== undefined) sender.onPacketSent = (frame, offset, sentMs) => log.add(frame, offset, sentMs);
    sender.onFrameSent = ({ shared, sendMs }) => {
      this.#stages.add('sendMs', sendMs);
      if (shared.frame.sensor === 0) this.#countSent(shared);
      this.#tests.onSent(shared);
    };
    sender.onFrameDropped = (shared) => {
      if (this.#tests.onLost(shared)) this.#events.onLatencyFrameLost();
    };
    sender.onRateChanged = () => {
      this.#events.onBudgetChanged();
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
    if (sender !== null) {
      this.#sendLoop.remove(sender);
      sender.clear();
    }
    this.#events.onEnded(end, detail);
  }
}
