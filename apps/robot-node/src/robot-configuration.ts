import type { DriveLimits, IceServer } from '@farpoint/protocol';
import type { TakePolicy } from '@farpoint/safety';
import type { BaseOptions } from './base/base-messages.ts';
import type { SinkOptions } from './drive/open-sink.ts';
import type { StreamMode } from './encode/stream-mode.ts';
import type { PicturePolicy } from './pictures/picture-plan.ts';
import type { CloudSensorOptions } from './sensors/cloud-sensor.ts';
import type { SignalingOptions } from './signaling/signaling-client.ts';
import type { RecordingOptions } from './telemetry/session-recording.ts';
import type { RateControlOptions } from './transport/make-rate-controller.ts';

/** All that a robot is made of. */
export interface RobotOptions extends RateControlOptions {
  id: string;
  name: string;
  signaling: Pick<SignalingOptions, 'url' | 'key' | 'token' | 'ca'>;
  /** Sources of clouds, the main one first. */
  sensors: readonly CloudSensorOptions[];
  /** Simulated wheels; `null` where the real ones are. */
  base: BaseOptions | null;
  /** What moves the wheels. */
  sink: SinkOptions;
  limits: DriveLimits;
  takePolicy: TakePolicy;
  /** Where the robot remembers its emergency stop over restarts. */
  stateFolder: string;
  /** Robots' port of a reference signaling service; its operators prove nothing of themselves. */
  referenceSignaling?: string | undefined;
  /** `auto`: our own coded formats to whoever reads them; `points64`: that to everyone. */
  mode: StreamMode;
  pictures: PicturePolicy;
  maxOperators: number;
  /** An operator of whom nothing is heard for this long is gone, ms. */
  silenceMs: number;
  connectTimeoutMs: number;
  /** Besides those of the signaling service. */
  iceServers: IceServer[];
  portRange?: readonly [number, number] | undefined;
  /** `relay`: media by TURN servers only. */
  icePolicy: 'all' | 'relay';
  /** File for a log of every packet sent, written when the robot closes. */
  packetLog?: string | undefined;
  /** File for a log of every frame, written when the robot closes. */
  frameLog?: string | undefined;
  /** File for what each stream does in each 100 ms, one JSON object a line. */
  statisticsFile?: string | undefined;
  /** What everything is recorded in; left out, nothing is. */
  record?: RecordingOptions | undefined;
}
