/** Passes the link's events to a client's parts and listeners. */
import type { CloudReceiver } from '../cloud/cloud-receiver.ts';
import type { RobotCommands } from '../commands/robot-commands.ts';
import type { Driver } from '../drive/driver.ts';
import type { SeenView } from '../drive/seen-view.ts';
import type { LatencyProbe } from '../latency/latency-probe.ts';
import type { RobotLinkEvents } from '../link/robot-link.ts';
import type { PictureFeed } from '../pictures/picture-feed.ts';
import { givesYou } from '../session/robot-people.ts';
import type { RobotSound } from '../sound/robot-sound.ts';
import type { StreamStatistics } from '../statistics/stream-statistics.ts';
import type { StopDelivery } from '../stop/stop-delivery.ts';
import { VideoTracks } from '../video/video-tracks.ts';
import type { Emitter } from './emitter.ts';
import { forwardedEvents } from './forwarded-events.ts';
import type { RobotEvents } from './robot-events.ts';

/** The client's parts. They are read when an event comes, because some are created after the link. */
export interface LinkedClient {
  readonly driver: Driver;
  readonly latency: LatencyProbe;
  readonly statistics: StreamStatistics;
  readonly seen: SeenView;
  readonly stops: StopDelivery;
  readonly commands: RobotCommands;
  pointsAtMs: number;
}

/** The client's private parts. */
export interface ClientParts {
  readonly emitter: Emitter<RobotEvents>;
  readonly receiver: CloudReceiver;
  readonly pictures: PictureFeed;
  readonly sound: RobotSound;
  /** Tells the robot which cloud formats this browser reads. */
  tellFormats(): void;
}

export function linkEvents(client: LinkedClient, parts: ClientParts): RobotLinkEvents {
  const { emitter } = parts;
  const tracks = new VideoTracks((track) => emitter.emit('videoTrack', track));
  return {
    ...forwardedEvents(emitter),
    ...sessionEvents(client, parts, tracks),
    ...driveEvents(client, parts),
    ...mediaEvents(parts, tracks),
  };
}

/** The beginning and end of sessions and paths, on which parts begin anew. */
function sessionEvents(client: LinkedClient, parts: ClientParts, tracks: VideoTracks) {
  const { emitter, receiver, pictures, sound } = parts;
  return {
    onPhase: (phase) => {
      if (phase !== 'live') {
        client.driver.reset();
        client.latency.fail('no-session');
        client.commands.reset();
        if (phase === 'none') sound.reset();
        else sound.release();
      }
      client.pointsAtMs = performance.now();
      emitter.emit('phase', phase);
    },
    onPath: (up) => {
      if (!up) sound.release();
      client.driver.onPath(performance.now());
      emitter.emit('path', up);
    },
    onGeneration: (generation) => {
      receiver.begin(generation);
      pictures.reset();
      tracks.reset();
      sound.reset();
      client.statistics.reset();
      client.seen.reset();
      client.stops.onSession();
      client.commands.reset();
      emitter.emit('session', generation);
    },
  } satisfies Partial<RobotLinkEvents>;
}

/** What the robot says of driving and of its emergency stop. */
function driveEvents(client: LinkedClient, { emitter, tellFormats }: ClientParts) {
  return {
    onWelcome: (welcome) => {
      tellFormats();
      client.driver.onLimits(welcome.limits);
      emitter.emit('welcome', welcome);
    },
    onLease: (lease) => {
      client.driver.onLease(lease);
      client.latency.onLease();
      emitter.emit('lease', lease);
    },
    onHandover: (handover) => {
      if (givesYou(handover)) client.driver.onHandedOver(performance.now());
      emitter.emit('handover', handover);
    },
    onEstop: (estop) => {
      client.stops.onState(estop);
      emitter.emit('estop', estop);
    },
    onRobotCommand: (command) => client.commands.onCommand(command),
    onCommandRun: (run) => client.commands.onRun(run),
    onCommandRefused: (refused) => client.commands.onRefused(refused),
    onRecording: (recording) => client.commands.onRecording(recording),
    onEstopAck: (press) => client.stops.onAck(press),
    onLatencyFrame: (frame) => client.latency.onRobotFrame(frame),
    onStages: (times, nowMs) => client.statistics.onStages(times, nowMs),
  } satisfies Partial<RobotLinkEvents>;
}

/** Clouds, pictures, videos and sound. */
function mediaEvents({ emitter, receiver, pictures, sound }: ClientParts, tracks: VideoTracks) {
  return {
    onCloudStream: (stream) => receiver.beginStream(stream),
    onCameras: (cameras) => {
      pictures.reset();
      emitter.emit('cameras', cameras);
    },
    onVideos: (videos) => {
      emitter.emit('videos', videos);
      tracks.list(videos.length);
    },
    onSound: (message) => {
      sound.latest = message;
      emitter.emit('sound', message);
    },
    onSoundLine: (line) => sound.connect(line),
    onVideoTrack: (track) => tracks.add(track),
    onPicture: (picture, nowMs) => pictures.add(picture, nowMs),
  } satisfies Partial<RobotLinkEvents>;
}
