/** What the robot sends of what it senses: clouds, pictures, videos and sound, and who gets how much of the path. */
import type { Logger } from '@farpoint/service';
import { monotonicMs, threadCpuMs } from '../ground/clock.ts';
import type { RobotCounters } from '../ground/robot-counters.ts';
import type { StageTimer } from '../ground/stage-timer.ts';
import { Budgets } from '../send/budgets/budgets.ts';
import type { CloudSensorOptions } from '../send/clouds/cloud-sensor.ts';
import { CloudSensors, type CloudSensorsEvents } from '../send/clouds/cloud-sensors.ts';
import type { FrameLog } from '../send/clouds/frame-log.ts';
import { RobotSound } from '../send/sound/robot-sound.ts';
import { SendLoop } from '../send/transport/send-loop.ts';
import type { Capture } from '../sense/capture/capture.ts';
import type { StreamMode } from '../sense/encode/plan.ts';
import type { PicturePolicy } from '../sense/pictures/picture-plan.ts';
import { openSoundDevices, type SoundOptions } from '../sense/sound/open-sound-devices.ts';
import type { VideoCamera } from '../sense/video/video-encoder.ts';
import type { SessionRecording } from '../tell/session-recording.ts';
import type { Broadcast } from './broadcast/broadcast.ts';
import type { BroadcastOptions } from './broadcast/broadcast-options.ts';
import { openBroadcast } from './broadcast/open-broadcast.ts';
import { RobotCameras } from './cameras/robot-cameras.ts';
import type { ReferenceProfile } from './reference/reference-profile.ts';
import type { OperatorSession } from './session/operator-session.ts';

export interface StreamsOptions {
  /** The robot's, for people. */
  name: string;
  sensors: readonly CloudSensorOptions[];
  pictures: PicturePolicy;
  sound: SoundOptions;
  broadcast?: BroadcastOptions | undefined;
  mode: StreamMode;
}

export interface StreamsParts {
  /** The sources of clouds, the main one first. */
  captures: readonly Capture[];
  videos: readonly VideoCamera[];
  recording: SessionRecording | null;
  counters: RobotCounters;
  stages: StageTimer;
  frameLog: FrameLog | undefined;
  log: Logger;
}

/** Who gets the streams. Asked each time, because operators come and go. */
export interface StreamsAudience {
  readonly operators: ReadonlyMap<string, OperatorSession>;
  /** `null` if the robot is not visible to the reference system's operators. */
  readonly reference: ReferenceProfile | null;
  /** Who drives; `null` if nobody does. */
  readonly driver: string | null;
}

export interface StreamsEvents extends CloudSensorsEvents {
  /** A video has stopped or returned. */
  onVideosChanged(): void;
}

export class RobotStreams {
  readonly sensors: CloudSensors;
  readonly cameras: RobotCameras;
  readonly sound: RobotSound;
  /** What feeds viewers through a relay; `null` if it is not enabled. */
  readonly broadcast: Broadcast | null;
  readonly budgets: Budgets;
  readonly sendLoop = new SendLoop(monotonicMs, threadCpuMs);

  constructor(
    options: StreamsOptions,
    parts: StreamsParts,
    audience: StreamsAudience,
    events: StreamsEvents,
  ) {
    const { captures, videos, recording, counters, stages, frameLog, log } = parts;
    const { sendLoop } = this;
    const driver = () => audience.driver;
    const watching = () => [
      ...audience.operators.values(),
      ...(this.broadcast === null ? [] : [this.broadcast]),
    ];
    const targets = () => [...watching(), ...(audience.reference?.targets ?? [])];
    this.budgets = new Budgets({ targets, driver, mayCode: options.mode === 'auto' });
    const fanOut = {
      targets,
      sendLoop,
      counters,
      frameLog,
      onFrame: recording === null ? undefined : recording.frame.bind(recording),
      wantedAnyway: () => recording?.wantsClouds === true,
      stages,
      now: monotonicMs,
    };
    this.sensors = new CloudSensors(options.sensors, captures, fanOut, this.budgets, events);
    const capture = this.sensors.first.capture;
    recording?.cameras(capture.cameras, videos, (video) => this.cameras.videos.requestKeyFrame(video));
    const shared = {
      targets: () => audience.operators.values(),
      driver,
      onFrame: () => sendLoop.run(),
      log,
    };
    this.cameras = new RobotCameras({
      ...shared,
      policy: options.pictures,
      capture,
      videos,
      taker: recording,
      videoTargets: watching,
      onMade: (picture) => recording?.picture(picture),
      onStateChanged: () => {
        events.onVideosChanged();
        this.broadcast?.videosChanged();
      },
    });
    const devices = openSoundDevices(options.sound, log);
    this.sound = new RobotSound({ ...shared, devices, now: monotonicMs });
    this.broadcast = openBroadcast(options, this, { videos, sendLoop, budgets: this.budgets, log });
    sendLoop.onWork = (ms) => counters.stageSeconds.add('send', ms / 1000);
  }

  /** Updates every stream, and sends what is due. Call this every 25 ms. */
  update(): void {
    this.broadcast?.update();
    this.cameras.update(monotonicMs());
    this.sound.update();
    this.budgets.update();
    this.sendLoop.run();
  }

  async close(): Promise<void> {
    this.sendLoop.close();
    await this.broadcast?.close();
    for (const part of [this.cameras, this.sound, this.sensors]) await part.close();
  }
}
