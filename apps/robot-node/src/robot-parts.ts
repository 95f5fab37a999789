import type { Logger } from '@farpoint/service';
import { type GrantFiles, openGrantFiles } from './admit/access/grant-files.ts';
import { openRobotKey, type RobotKey } from './admit/access/robot-key-file.ts';
import type { RobotAudit } from './admit/audit/robot-audit.ts';
import type { VelocitySink } from './ground/velocity-sink.ts';
import { openSink } from './motion/drive/open-sink.ts';
import { guardedSensors, hasOdometry } from './motion/obstacles/guarded-sensors.ts';
import { type ObstacleStation, openObstacleGuard } from './motion/obstacles/obstacle-station.ts';
import type { RobotOptions } from './program/robot-configuration.ts';
import type { CloudSensorOptions } from './send/clouds/cloud-sensor.ts';
import { CloudSensors } from './send/clouds/cloud-sensors.ts';
import { openPlayedVideos } from './send/video/played-videos.ts';
import { BaseThread } from './sense/base/base-thread.ts';
import type { Capture } from './sense/capture/capture.ts';
import type { VideoCamera } from './sense/video/video-encoder.ts';
import { openVideoCameras, type VideoCameraOptions } from './serve/cameras/open-video-cameras.ts';
import { openCommands, type RobotCommands } from './serve/commands/open-commands.ts';
import { SessionRecording } from './tell/session-recording.ts';

/** Gives simulated sensors the world of the simulated base, so that they see the robot move. */
export function inWorld(
  sensors: readonly CloudSensorOptions[],
  base: BaseThread | null,
): CloudSensorOptions[] {
  return sensors.map((sensor) => {
    const { source } = sensor.capture;
    if (base === null || (source.kind !== 'sim' && source.kind !== 'sim-lidar')) return sensor;
    const { snapshot, things } = base;
    return { ...sensor, capture: { ...sensor.capture, source: { ...source, snapshot, things } } };
  });
}

/** The same for simulated cameras that are streamed as video. */
function videosInWorld(
  cameras: readonly VideoCameraOptions[],
  base: BaseThread | null,
): VideoCameraOptions[] {
  return cameras.map((camera) => {
    const { source } = camera;
    if (base === null || source.kind !== 'sim') return camera;
    const { snapshot, things } = base;
    return { ...camera, source: { ...source, snapshot, things } };
  });
}

/** What a robot is made of, opened and ready. */
export interface RobotParts {
  /** The sources of clouds, the main one first. */
  captures: readonly Capture[];
  /** What bounds the motion by their clouds. */
  obstacles: ObstacleStation;
  /** Simulated wheels; `null` for real ones. */
  base: BaseThread | null;
  sink: VelocitySink;
  recording: SessionRecording | null;
  /** `null` if everybody is admitted. */
  grants: GrantFiles | null;
  /** `null` if it can be neither read nor made. */
  robotKey: RobotKey | null;
  audit: RobotAudit;
  /** The cameras that are streamed as video. */
  videos: readonly VideoCamera[];
  /** What operators may make the robot do besides driving, and what does it. */
  commands: RobotCommands;
}

/**
 * Opens everything, or nothing.
 *
 * @throws {CaptureError} if a source of clouds cannot be opened
 * @throws {GrantKeysError} if the keys for grants cannot be used
 * @throws {RevocationJournalError} if nobody can tell any more which grants were revoked
 */
export async function openParts(options: RobotOptions, log: Logger, audit: RobotAudit): Promise<RobotParts> {
  const grants = await openGrantFiles(options);
  const robotKey = await openRobotKey(options.robotKey, log);
  const { record = null, foxglove = null, id } = options;
  const recording =
    record === null && foxglove === null ? null : await SessionRecording.open({ record, foxglove }, id, log);
  if (recording !== null) audit.alsoTell(recording);
  const base = options.base === null ? null : new BaseThread(options.base);
  let captures: Capture[] = [];
  try {
    const { sensors, ...guards } = guardedSensors(inWorld(options.sensors, base), options.obstacleGuard);
    captures = await CloudSensors.open(sensors, recording?.capture ?? null);
    captures.forEach(({ description }, i) => {
      log.info({ sensor: options.sensors[i]?.name, source: description }, 'source open');
    });
    const [main] = captures;
    const [{ capture } = { capture: null }] = options.sensors;
    const cameras = await openVideoCameras(videosInWorld(options.videos, base), log);
    const played = { bitsPerSecond: options.playedVideosBitsPerSecond, besides: cameras };
    const videos =
      main === undefined ? cameras : [...cameras, ...(await openPlayedVideos(main, played, log))];
    if (main !== undefined && capture !== null) recording?.announce(main, capture.framesPerSecond, videos);
    const sink = openSink(options.sink, base, log);
    const names = options.sensors.map(({ name }) => name);
    const obstacles = openObstacleGuard(
      { configuration: options.obstacleGuard, ...guards, captures, names },
      capture !== null && hasOdometry(capture.source),
      log,
    );
    const commands = openCommands(options.commands, recording, log);
    return { captures, obstacles, base, sink, recording, videos, grants, robotKey, audit, commands };
  } catch (error) {
    for (const capture of captures) await capture.close();
    await base?.close();
    await recording?.close();
    throw error;
  }
}
