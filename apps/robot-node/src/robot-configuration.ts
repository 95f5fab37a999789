import type { DriveLimits, IceServer } from '@farpoint/protocol';
import type { TakePolicy } from '@farpoint/safety';
import type { BaseOptions } from './base/base-messages.ts';
import type { SinkOptions } from './drive/open-sink.ts';
import type { StreamMode } from './encode/stream-mode.ts';
import type { VideoCameraOptions } from './options/videos.ts';
import type { PicturePolicy } from './pictures/picture-plan.ts';
import type { CloudSensorOptions } from './sensors/cloud-sensor.ts';
import type { SignalingOptions } from './signaling/signaling-client.ts';
import type { LiveOptions, RecordingOptions } from './telemetry/session-recording.ts';
import type { RateControlOptions } from './transport/make-rate-controller.ts';

/** Everything that a robot is made of. */
export interface RobotOptions extends RateControlOptions {
  id: string;
  name: string;
  signaling: Pick<SignalingOptions, 'url' | 'key' | 'token' | 'ca'>;
  /** Sources of clouds, the main one first. */
  sensors: readonly CloudSensorOptions[];
  /** Simulated wheels; `null` for real ones. */
  base: BaseOptions | null;
  /** What moves the wheels. */
  sink: SinkOptions;
  limits: DriveLimits;
  takePolicy: TakePolicy;
  /** Where the robot remembers its emergency stop across restarts. */
  stateFolder: string;
  /** The reference signaling service's port for robots. Its operators are not authenticated. */
  referenceSignaling?: string | undefined;
  /** `auto`: our own coded formats for everyone who reads them; `points64`: only `points64`, for everyone. */
  mode: StreamMode;
  pictures: PicturePolicy;
  /** Cameras that are streamed as video. */
  videos: readonly VideoCameraOptions[];
  /** Maximum rate of each video that a recording plays. */
  playedVideosBitsPerSecond: number;
  maxOperators: number;
  /** An operator that has not been heard from for this long is gone, ms. */
  silenceMs: number;
  connectTimeoutMs: number;
  /** In addition to those from the signaling service. */
  iceServers: IceServer[];
  portRange?: readonly [number, number] | undefined;
  /** `relay`: media through TURN servers only. */
  icePolicy: 'all' | 'relay';
  /** File for a log of every packet sent, written when the robot closes. */
  packetLog?: string | undefined;
  /** File for a log of every frame, written when the robot closes. */
  frameLog?: string | undefined;
  /** File for the statistics of each stream in each 100 ms, one JSON object per line. */
  statisticsFile?: string | undefined;
  /** Where everything is recorded; if undefined, nothing is recorded. */
  record?: RecordingOptions | undefined;
  /** Where the same is served live; if undefined, nowhere. */
  foxglove?: LiveOptions | undefined;
}
