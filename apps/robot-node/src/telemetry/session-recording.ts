import {
  type Command,
  type LatencyMeasured,
  PICTURE_CHUNK_DATA_BYTES,
  PICTURE_CHUNK_HEADER_BYTES,
  type Twist,
} from '@farpoint/protocol';
import { type CloudKind, type DropKind, SessionRecorder } from '@farpoint/recording';
import type { CommandVerdict, DriveGuard } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import type { TimedBaseState } from '../base/base.ts';
import type { Capture, CaptureRecording } from '../capture/capture.ts';
import type { ReadyFrame } from '../capture/capture-messages.ts';
import type { CameraDescription } from '../capture/frame-source.ts';
import { monotonicMs } from '../clock.ts';
import type { ReadyPicture } from '../pictures/picture-messages.ts';
import { durationWords, recordingBytesPerSecond, sizeWords } from './recording-rate.ts';
import type { StreamStatistics } from './stream-statistics.ts';

export interface RecordingOptions {
  /** The MCAP file; there must be none yet. */
  path: string;
  compression: 'none' | 'zstd';
  /** Clouds a second at most; 0 records none. */
  clouds: Readonly<Record<CloudKind, number>>;
  /** It ends, whole, before it is larger. */
  mostBytes: number;
}

const MORE_ROOM =
  'for longer recordings: a larger --record-max, or fewer clouds (--record-clouds, --record-sent-fps)';

/** What the main thread tells a recording. The clouds come from the capture thread. */
export class SessionRecording {
  readonly capture: CaptureRecording;
  readonly #recorder: SessionRecorder;
  readonly #options: RecordingOptions;
  readonly #log: Logger;

  private constructor(recorder: SessionRecorder, options: RecordingOptions, log: Logger) {
    this.#recorder = recorder;
    this.#options = options;
    this.#log = log;
    this.capture = { clouds: recorder.clouds, perSecond: options.clouds };
  }

  /** @throws {RecordingError} where the file exists already, or cannot be made */
  static async open(options: RecordingOptions, robotId: string, log: Logger): Promise<SessionRecording> {
    const { path, compression, mostBytes } = options;
    // The robot's clock is monotonic; recordings are in the time of day.
    const epochNs = BigInt(Math.round((Date.now() - monotonicMs()) * 1000)) * 1000n;
    const recorder = await SessionRecorder.open({ path, compression, robotId, epochNs, mostBytes });
    recorder.onFailure = (error) => log.error({ err: error }, 'the recording ends; the robot goes on');
    recorder.onFull = () =>
      log.warn(
        { path, bytes: recorder.bytes, remedy: MORE_ROOM },
        `the recording has reached ${sizeWords(mostBytes)} and is closed, whole; the robot goes on`,
      );
    return new SessionRecording(recorder, options, log);
  }

  /** Says how fast it will grow, and where it ends. */
  announce(
    { description, cameras }: Pick<Capture, 'description' | 'cameras'>,
    mostFramesPerSecond: number,
  ): void {
    const { capacity, framesPerSecond = mostFramesPerSecond } = description;
    const { path, clouds, mostBytes } = this.#options;
    const bytesPerSecond = recordingBytesPerSecond({
      perSecond: clouds,
      points: capacity,
      framesPerSecond: Math.min(framesPerSecond, mostFramesPerSecond),
      pictures: cameras.length > 0,
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

  /** For `/metrics`: written, and not written because the disk or the processor did not keep up. */
  get counts(): { messages: number; bytes: number; dropped: Readonly<Record<DropKind, number>> } {
    const { messages, bytes, dropped } = this.#recorder;
    return { messages, bytes, dropped };
  }

  /** Whose pictures there are. */
  cameras(cameras: readonly CameraDescription[]): void {
    this.#recorder.cameras(cameras.map(({ name, ofCloud = false }) => ({ name, ofCloud })));
  }

  /** A picture as it was made for operators. */
  picture({ header, capturedAtMs, fileBytes, chunks }: ReadyPicture): void {
    const file = new Uint8Array(fileBytes);
    chunks.forEach((chunk, i) => {
      file.set(chunk.subarray(PICTURE_CHUNK_HEADER_BYTES), i * PICTURE_CHUNK_DATA_BYTES);
    });
    this.#recorder.picture(header.camera, capturedAtMs, header.format, file);
  }

  /** What the wheels are given. */
  velocity(twist: Twist): void {
    this.#recorder.velocity(monotonicMs(), twist);
  }

  command(session: string, { sequence, timeMs, twist }: Command, verdict: CommandVerdict): void {
    const outcome = verdict.accepted
      ? { accepted: true, applied: verdict.twist }
      : { accepted: false, reason: verdict.reason, detail: verdict.detail };
    this.#recorder.json('command', monotonicMs(), { session, sequence, timeMs, twist, ...outcome });
  }

  telemetry(state: TimedBaseState, guard: DriveGuard, operators: number): void {
    const { timeMs, pose, twist, battery, contact } = state;
    const drive = guard.state(monotonicMs(), contact);
    this.#recorder.state(timeMs, pose, twist);
    this.#recorder.json('telemetry', timeMs, { pose, twist, battery, contact, drive, operators });
  }

  estimates(lines: readonly StreamStatistics[]): void {
    for (const line of lines) this.#recorder.json('estimate', line.timeMs, line);
  }

  /** From a frame's capture to its packets, and to the thread that sends them. */
  frame(frame: ReadyFrame): void {
    const { frameNumber, format, points, packets, validPoints, latencyTest } = frame;
    const { capturedAtMs, readyMs, captureMs, sampleMs, packMs } = frame;
    const now = monotonicMs();
    this.#recorder.json('latency', now, {
      ...{ frameNumber, format, points, packets, validPoints, latencyTest },
      ...{ capturedAtMs, captureMs, sampleMs, packMs },
      readyAfterMs: readyMs - capturedAtMs,
      sendingAfterMs: now - capturedAtMs,
    });
  }

  /** Motion to photon, as the operator's display showed it. */
  latencyMeasured(session: string, { id, frameNumber, mtpMs, firstMs }: LatencyMeasured): void {
    this.#recorder.json('motionToPhoton', monotonicMs(), { session, id, frameNumber, mtpMs, firstMs });
  }

  close(): Promise<void> {
    return this.#recorder.close();
  }
}
