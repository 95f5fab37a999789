import type { AfterGap, DriveLimits, EstopReleasePolicy, IceServer, Quantity } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import type { TakePolicy } from '@farpoint/safety';
import type { RobotAuditOptions } from '../admit/audit/open-robot-audit.ts';
import type { SignalingOptions } from '../admit/signaling/signaling-client.ts';
import type { SinkOptions } from '../motion/drive/open-sink.ts';
import type { FenceOptions } from '../motion/geofence/open-geofence.ts';
import type { ObstacleGuardConfiguration } from '../motion/obstacles/guarded-sensors.ts';
import type { MotionLimits } from '../motion/open-drive.ts';
import type { ReturnConfiguration } from '../motion/return/return-announcer.ts';
import type { RobotStopsOptions } from '../motion/stops/open-stops.ts';
import type { CloudSensorOptions } from '../send/clouds/cloud-sensor.ts';
import type { RateControlOptions } from '../send/transport/make-rate-controller.ts';
import type { BaseOptions } from '../sense/base/base-messages.ts';
import type { StreamMode } from '../sense/encode/plan.ts';
import type { PicturePolicy } from '../sense/pictures/picture-plan.ts';
import type { SoundOptions } from '../sense/sound/open-sound-devices.ts';
import type { BroadcastOptions } from '../serve/broadcast/broadcast-options.ts';
import type { VideoCameraOptions } from '../serve/cameras/open-video-cameras.ts';
import type { CommandsConfiguration } from '../serve/commands/command-configuration.ts';
import type { OperatorPlacesOptions } from '../serve/session/operator-places.ts';
import type { AlarmRule } from '../tell/alarms/alarm-board.ts';
import type { LiveOptions, RecordingOptions } from '../tell/recording-options.ts';
import type { SpanOptions } from '../tell/spans/span-exporter.ts';
import type { ListStatus } from '../tell/status-reporter.ts';

/** Everything that a robot is made of. */
export interface RobotOptions extends RateControlOptions {
  id: string;
  name: string;
  signaling: Pick<SignalingOptions, 'url' | 'key' | 'token' | 'ca'>;
  /** What the list of robots shows of it to operators without a session. */
  listStatus: ListStatus;
  /** Of its software. */
  version: string;
  /** File with the keys whose grants admit operators; if undefined, everybody is admitted. */
  grantKeys?: string | undefined;
  /** File with the key by which operators recognise the robot. */
  robotKey: string;
  /** Files with lists of revoked grants, besides those from the signaling service. */
  revocations: readonly string[];
  /** Where it is recorded who did what; if undefined, nowhere. */
  audit?: RobotAuditOptions | undefined;
  /** Sources of clouds, the main one first. */
  sensors: readonly CloudSensorOptions[];
  /** Simulated wheels; `null` for real ones. */
  base: BaseOptions | null;
  /** What moves the wheels. */
  sink: SinkOptions;
  limits: DriveLimits;
  motion: MotionLimits;
  /** What bounds its motion by what its clouds show. */
  obstacleGuard: ObstacleGuardConfiguration;
  /** The numbers of its topics that are shown over time. */
  quantities: readonly Quantity[];
  /** Limits beyond which a value is an alarm. */
  alarms: readonly AlarmRule[];
  /** The model that operators see, as far as no topic tells it. */
  model?: TopicReading | undefined;
  takePolicy: TakePolicy;
  /** Who may release what an operator has latched. */
  estopRelease: EstopReleasePolicy;
  /** What happens when commands come again after a gap that stopped the robot. */
  afterGap: AfterGap;
  /** After a shorter gap it moves on if the hand has held on, ms. */
  resumeWithinMs: number;
  /** Where it may go; if undefined, anywhere. */
  fence?: FenceOptions | undefined;
  /** How it drives back by itself when it hears no operator; if undefined, never. */
  returns?: ReturnConfiguration | undefined;
  /** What operators may make it do besides driving; if undefined, nothing. */
  commands?: CommandsConfiguration | undefined;
  /** The stops at the robot itself. */
  stops: RobotStopsOptions;
  /** Where the robot remembers its emergency stop and revoked grants across restarts. */
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
  /** A microphone and a loudspeaker, as far as there are any. */
  sound: SoundOptions;
  /** Where everything is sent once for any number of viewers; if undefined, nowhere. */
  broadcast?: BroadcastOptions | undefined;
  /** How many operators there may be, and of one person. */
  places: OperatorPlacesOptions;
  /** Whether operators whose grant lets them only watch may point at a spot that the others see. */
  watchersPoint: boolean;
  /** An operator that has not been heard from for this long is gone, ms. */
  silenceMs: number;
  /** A driver whose page has said nothing for this long loses the lease, ms. */
  leaseSilenceMs: number;
  connectTimeoutMs: number;
  /** In addition to those from the signaling service. */
  iceServers: IceServer[];
  portRange?: readonly [number, number] | undefined;
  /** `relay`: media through TURN servers only. */
  icePolicy: 'all' | 'relay';
  /** Where measurements are written; if undefined, nothing is measured. */
  measurementFolder?: string | undefined;
  /** Where everything is recorded; if undefined, nothing is recorded. */
  record?: RecordingOptions | undefined;
  /** Where the same is served live; if undefined, nowhere. */
  foxglove?: LiveOptions | undefined;
  /** Where spans of clouds and commands go; if undefined, nowhere. */
  spans?: SpanOptions | undefined;
}

export function hasSound({ sound: { microphone, loudspeaker } }: Pick<RobotOptions, 'sound'>): boolean {
  return microphone !== undefined || loudspeaker !== undefined;
}
