import type { AuditEvent } from '@farpoint/audit';
import type { CameraDescription, TimedBaseState } from '@farpoint/cloud-source';
import {
  type Command,
  type LatencyMeasured,
  PICTURE_CHUNK_DATA_BYTES,
  PICTURE_CHUNK_HEADER_BYTES,
  type Twist,
  type VideoCodec,
  zeroTwist,
} from '@farpoint/protocol';
import {
  type CloudKind,
  type DropKind,
  type LiveReport,
  type RecordedAlarm,
  type RecordedQuantity,
  SessionRecorder,
  type VideoFormatName,
} from '@farpoint/recording';
import type { CommandVerdict } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import { monotonicMs } from '../ground/clock.ts';
import type { MotionStatus } from '../motion/drive/motion-status.ts';
import type { Capture, CaptureRecording } from '../sense/capture/capture.ts';
import type { ReadyFrame } from '../sense/capture/capture-messages.ts';
import type { ReadyPicture } from '../sense/pictures/picture-messages.ts';
import type { VideoCamera } from '../sense/video/video-encoder.ts';
import type { EncodedPicture } from '../sense/video/video-frame.ts';
import type { VideoTaker } from '../sense/video/video-hub.ts';
import type { RecordControl } from './record-control.ts';
import type { RecordedVideos, SessionOutputs } from './recording-options.ts';
import { durationWords, recordingBytesPerSecond, sizeWords } from './recording-rate.ts';
import type { TelemetryTaker } from './sample-board.ts';
import type { StreamStatistics } from './stream-statistics.ts';

const HOSTS = { localhost: '127.0.0.1', network: '0.0.0.0' } as const;
/**
 * Foxglove's viewers at a time. Chosen: each takes all that is recorded, so that more would cost operators
 * their processor.
 */
const MOST_VIEWERS = 8;
/**
 * The least time between two key frames that are requested for one video: each costs operators some bits, ms.
 * Chosen: who joins a live view waits so long at most.
 */
const KEY_FRAME_MS = 1000;
const NO_CLOUDS: Readonly<Record<CloudKind, number>> = { captured: 0, sent: 0 };
const MORE_ROOM =
  'for longer recordings: a larger --record-max, or fewer clouds (--record-clouds, --record-fps)';

const FORMATS: Readonly<Record<VideoCodec, VideoFormatName>> = { H264: 'h264', VP8: 'vp8' };
const UNSEEN = 'these cameras are in VP8, which this robot plays but Foxglove and Lichtblick do not show';
const SEEN_REMEDY = 'an H.264 encoder (docs/video.md)';

/** The main thread's part of a recording, and of the live server. The clouds come from the capture thread. */
export class SessionRecording implements RecordControl, VideoTaker {
  readonly robotId: string;
  readonly capture: CaptureRecording;
  readonly #recorder: SessionRecorder;
  readonly #options: SessionOutputs;
  readonly #log: Logger;
  readonly #keyFramesMs = new Map<number, number>();
  /** Called when a file begins, or ends before the robot does. */
  onChanged: (() => void) | null = null;
  #beganMs = monotonicMs();

  private constructor(recorder: SessionRecorder, options: SessionOutputs, robotId: string, log: Logger) {
    this.robotId = robotId;
    this.#recorder = recorder;
    this.#options = options;
    this.#log = log;
    this.capture = {
      clouds: recorder.clouds,
      perSecond: options.record?.clouds ?? NO_CLOUDS,
      livePerSecond: options.foxglove?.cloudsPerSecond ?? 0,
    };
  }

  /** @throws {RecordingError} if the file already exists or cannot be created */
  static async open(options: SessionOutputs, robotId: string, log: Logger): Promise<SessionRecording> {
    const { record, foxglove } = options;
    const { path = null, compression = 'none', mostBytes = Number.POSITIVE_INFINITY } = record ?? {};
    // The robot's clock is monotonic; recordings use the time of day.
    const epochNs = BigInt(Math.round((Date.now() - monotonicMs()) * 1000)) * 1000n;
    const live =
      foxglove === null
        ? undefined
        : {
            host: HOSTS[foxglove.reach],
            port: foxglove.port,
            mostClients: MOST_VIEWERS,
            allowedOrigins: foxglove.allowedOrigins,
            ownNames: foxglove.ownNames,
          };
    const recorder = await SessionRecorder.open({ path, compression, robotId, epochNs, mostBytes, live });
    const recording = new SessionRecording(recorder, options, robotId, log);
    recorder.onFailure = (error) => {
      log.error({ err: error }, 'the recording ends; the robot goes on');
      recording.onChanged?.();
    };
    recorder.onFull = () => {
      log.warn(
        { path: recorder.file.path, bytes: recorder.file.size, remedy: MORE_ROOM },
        `the recording has reached ${sizeWords(mostBytes)} and is closed, whole; the robot goes on`,
      );
      recording.onChanged?.();
    };
    recording.#logLive();
    return recording;
  }

  /** Whether the session is being written to a file now. */
  get writes(): boolean {
    return this.#recorder.writing;
  }

  get folder(): RecordControl['folder'] {
    return this.#options.record?.folder ?? null;
  }

  /** The file that the robot itself writes from its start is not the operators'. */
  get isOwn(): boolean {
    return this.writes && this.#recorder.file.path === this.#options.record?.path;
  }

  get progress(): RecordControl['progress'] {
    return { bytes: this.#recorder.file.size, forS: (monotonicMs() - this.#beganMs) / 1000 };
  }

  async start(path: string): Promise<void> {
    await this.#recorder.file.open(path);
    this.#beganMs = monotonicMs();
    this.#log.info({ path }, 'a recording begins');
    this.onChanged?.();
  }

  async stop(): Promise<string | null> {
    const { path } = this.#recorder.file;
    try {
      await this.#recorder.file.close();
    } finally {
      this.onChanged?.();
    }
    this.#log.info({ path }, 'the recording is complete');
    return path;
  }

  bookmark(by: string, text: string): void {
    this.#recorder.bookmark(monotonicMs(), by, text);
  }

  /** Logs how fast the recording will grow, and where it ends. */
  announce(
    { description, cameras }: Pick<Capture, 'description' | 'cameras'>,
    mostFramesPerSecond: number,
    videos: readonly Pick<VideoCamera, 'most'>[],
  ): void {
    const { record } = this.#options;
    if (record === null) return;
    const { capacity, framesPerSecond = mostFramesPerSecond } = description;
    const { path, clouds, mostBytes } = record;
    if (path === null) return;
    const bytesPerSecond = recordingBytesPerSecond({
      perSecond: clouds,
      points: capacity,
      framesPerSecond: Math.min(framesPerSecond, mostFramesPerSecond),
      pictures: cameras.length > 0,
      videoBitsPerSecond:
        record.videos === 'none' ? 0 : videos.reduce((sum, { most }) => sum + most.bitsPerSecond, 0),
    });
    const rate = `up to ${sizeWords(bytesPerSecond)} a second while an operator watches`;
    const end = Number.isFinite(mostBytes)
      ? `it ends at ${sizeWords(mostBytes)} (--record-max), in ${durationWords(mostBytes / bytesPerSecond)} at the soonest`
      : 'it has no limit (--record-max)';
    this.#log.info(
      { path, clouds, bytesPerSecond: Math.round(bytesPerSecond) },
      `recording: ${rate}; ${end}`,
    );
  }

  /** For `/metrics`: what was written, and what was not because the disk or the processor did not keep up. */
  get counts(): { messages: number; bytes: number; dropped: Readonly<Record<DropKind, number>> } {
    const { file, dropped } = this.#recorder;
    return { messages: file.messages, bytes: file.bytes, dropped };
  }

  /** Whether files are written, or may be. */
  get hasFile(): boolean {
    return this.#options.record !== null;
  }

  /** Whether there is a server for live viewers, and what it did so far. */
  get live(): { listening: boolean; report: LiveReport | null } | null {
    const { live, liveReport } = this.#recorder;
    return live === null ? null : { listening: 'port' in live, report: liveReport };
  }

  /** Whether a live viewer wants clouds as the source gives them, even if no operator watches. */
  get wantsClouds(): boolean {
    return this.#recorder.liveWishes.clouds.captured;
  }

  /**
   * Sets the cameras that have pictures, and those that have video.
   *
   * @param requestKeyFrame asks for a frame of a video that can be decoded without any other
   */
  cameras(
    cameras: readonly CameraDescription[],
    videos: readonly Pick<VideoCamera, 'name' | 'codecs'>[],
    requestKeyFrame: (video: number) => void,
  ): void {
    this.#recorder.cameras(cameras.map(({ name, ofCloud = false }) => ({ name, ofCloud })));
    this.#recorder.onKeyFrameNeeded = (video) => {
      const now = monotonicMs();
      if (now - (this.#keyFramesMs.get(video) ?? Number.NEGATIVE_INFINITY) < KEY_FRAME_MS) return;
      this.#keyFramesMs.set(video, now);
      requestKeyFrame(video);
    };
    this.#recorder.videos(
      videos.map(({ name, codecs }) => ({ name, format: FORMATS[codecs[0] as VideoCodec] })),
    );
    if (this.#recordedVideos === 'none' && this.#options.foxglove === null) return;
    const unseen = videos.filter(({ codecs }) => codecs[0] === 'VP8').map(({ name }) => name);
    if (unseen.length > 0) this.#log.warn({ cameras: unseen, remedy: SEEN_REMEDY }, UNSEEN);
  }

  wants(video: number): boolean {
    const { writing, liveWishes } = this.#recorder;
    return (writing && this.#recordedVideos === 'always') || liveWishes.videos.includes(video);
  }

  /** Records a frame of a video as it was encoded for operators. */
  take(video: number, { capturedAtMs, key, bytes }: EncodedPicture, codec: VideoCodec): void {
    const format = FORMATS[codec];
    this.#recorder.video({ video, capturedAtMs, key, format, bytes }, this.#recordedVideos !== 'none');
  }

  /** Records a picture as it was made for operators. */
  picture({ header, capturedAtMs, fileBytes, chunks }: ReadyPicture): void {
    const file = new Uint8Array(fileBytes);
    chunks.forEach((chunk, i) => {
      file.set(chunk.subarray(PICTURE_CHUNK_HEADER_BYTES), i * PICTURE_CHUNK_DATA_BYTES);
    });
    this.#recorder.picture(header.camera, capturedAtMs, header.format, file);
  }

  /** Sets the quantities and alarms that are recorded. @returns what takes them, and the reports of components */
  telemetryTaker(quantities: readonly RecordedQuantity[], alarms: readonly RecordedAlarm[]): TelemetryTaker {
    this.#recorder.telemetry(quantities, alarms);
    return this.#recorder;
  }

  /** Records the velocity that the wheels are given. */
  velocity(twist: Twist): void {
    this.#recorder.velocity(monotonicMs(), twist);
  }

  command(session: string, { sequence, timeMs, twist }: Command, verdict: CommandVerdict): void {
    if (!this.#recorder.takes('command')) return;
    const outcome = verdict.accepted
      ? { accepted: true, applied: verdict.twist }
      : { accepted: false, reason: verdict.reason, detail: verdict.detail };
    this.#recorder.json('command', monotonicMs(), { session, sequence, timeMs, twist, ...outcome });
  }

  telemetry(state: TimedBaseState, status: MotionStatus, operators: number): void {
    const { timeMs, pose, battery, contact } = state;
    const twist = state.twist ?? zeroTwist();
    this.#recorder.state(timeMs, pose, twist);
    if (!this.#recorder.takes('telemetry')) return;
    const nowMs = monotonicMs();
    const drive = status.drive(nowMs, contact);
    const motion = status.state(nowMs);
    this.#recorder.json('telemetry', timeMs, { pose, twist, battery, contact, drive, motion, operators });
  }

  estimates(lines: readonly StreamStatistics[]): void {
    for (const line of lines) this.#recorder.json('estimate', line.timeMs, line);
  }

  /** Records the times from a frame's capture to its packets, and to the thread that sends them. */
  frame(frame: ReadyFrame): void {
    if (!this.#recorder.takes('latency')) return;
    const { frameNumber, format, points, packets, validPoints, latencyTest } = frame;
    const { capturedAtMs, readyMs, captureMs, sampleMs, packMs } = frame;
    const now = monotonicMs();
    this.#recorder.json('latency', now, {
      frameNumber,
      format,
      points,
      packets,
      validPoints,
      latencyTest,
      capturedAtMs,
      captureMs,
      sampleMs,
      packMs,
      readyAfterMs: readyMs - capturedAtMs,
      sendingAfterMs: now - capturedAtMs,
    });
  }

  /** Records motion-to-photon latency as measured at the operator's display. */
  latencyMeasured(session: string, { id, frameNumber, mtpMs, firstMs }: LatencyMeasured): void {
    this.#recorder.json('motionToPhoton', monotonicMs(), { session, id, frameNumber, mtpMs, firstMs });
  }

  /** Records what the audit log records. */
  record(event: AuditEvent): void {
    if (this.#recorder.takes('audit')) this.#recorder.json('audit', monotonicMs(), event);
  }

  close(): Promise<void> {
    return this.#recorder.close();
  }

  get #recordedVideos(): RecordedVideos {
    return this.#options.record?.videos ?? 'none';
  }

  #logLive(): void {
    const { foxglove } = this.#options;
    const { live } = this.#recorder;
    if (live === null || foxglove === null) return;
    const { reach } = foxglove;
    if ('failed' in live) {
      const remedy = 'another --foxglove-port, or end the program that has this one';
      this.#log.error({ port: foxglove.port, remedy }, `no server for Foxglove: ${live.failed}`);
    } else if (reach === 'network')
      this.#log.warn({ ...live, reach }, 'everybody in the network can watch this robot in Foxglove');
    else this.#log.info({ ...live, reach }, 'server for Foxglove');
  }
}
