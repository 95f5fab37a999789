/**
 * `window.farpoint`: what end-to-end tests and benchmarks can read from the page and do with it. Times in ms, rates
 * per second. It can do nothing that the page's own controls cannot do.
 */
import type {
  GripLoss,
  LatencyResult,
  LeaseState,
  RobotListing,
  SessionLoss,
  SessionPhase,
  SignalingState,
  VideoCodec,
} from '@farpoint/operator';
import type { DriveState, LatencyFrame } from '@farpoint/protocol';
import type { HeadsetView } from '../ground/headset-settings.ts';
import type { NearHit } from '../ground/near-field/directions.ts';
import type { ShownConsole } from '../scene/console/vr-console.ts';
import type { ShownNotice } from '../scene/headset/notice-sign.ts';
import type { RobotFigures } from '../scene/robot-model/robot-figures.ts';
import type { DrivePath } from '../scene/view/drive-path.ts';
import type { NearRing } from '../scene/view/near-ring.ts';
import type { PageStats } from '../words/page-stats.ts';
import type { ViewFigures } from '../words/view-words.ts';
import type { DriveRecording } from './drive-record.ts';

export interface PageState {
  signaling: SignalingState;
  session: SessionPhase;
  /** Sessions established since the page was loaded. */
  sessionsOpened: number;
  lastLoss: SessionLoss | null;
  robotId: string | null;
  robotListed: boolean;
  /** The line that the page shows about the link. */
  link: string;
  /** The last notice that the page showed: a refusal or failure. */
  notice: string | null;
  holder: LeaseState['holder'];
  estop: boolean;
  drive: DriveState | null;
  battery: number | null;
  /** base_link in the world, REP-103: metres, radians. */
  body: { x: number; y: number; z: number; yaw: number } | null;
  /** m/s and rad/s, as measured by the robot. */
  velocity: { linear: number; angular: number } | null;
  /** Whether commands are being sent, and from which device. */
  driving: boolean;
  input: string | null;
  /** Why a grip that is held does not drive. */
  gripLost: GripLoss | null;
  /** The way that is shown on the floor before the robot: metres until it stands, and how much of the wish it follows. */
  path: DrivePath['shown'];
  /** What is near the robot: the nearest, the words that the page shows, and what is drawn around the robot. */
  near: NearProbe;
  /** What is drawn of the navigator's path and map: number of points, and of cells that are not unknown. */
  navigation: { pathPoints: number; mapCells: number };
  /** What is drawn of the robot's model: moving links, shapes, where the joints are (rad, m), and whether it is in view. */
  model: RobotFigures['shown'];
  vr: boolean;
  /** Height of the grid, and how far the view from above reaches, metres. */
  scene: { gridM: number; reachM: number };
  /** Where the view stands, REP-103 (m, rad), and whether that is a prediction. */
  view: { x: number; y: number; z: number; yaw: number } & ViewFigures;
}

export type { PageStats };

/** What the page shows of what is near the robot. */
export interface NearProbe {
  /** In each direction, the nearest first. */
  hits: NearHit[];
  line: string;
  details: string;
  ring: NearRing['shown'];
  /** Where the edge of the view is red, radians counter-clockwise from up. */
  blocked: number | null;
}

/** What is currently drawn. */
export interface DrawnProbe {
  /** Whether a surface is drawn instead of points. */
  surface: boolean;
  /** Points or samples of a surface that are drawn, and how many of the points have the green of the latency test. */
  points: number;
  green: number;
  /** Bounds of the drawn points in the world (REP-103), metres. */
  bounds: { min: [number, number, number]; max: [number, number, number] } | null;
  /** Pose of the camera for the newest frame: metres, radians. */
  camera: { x: number; y: number; z: number; yaw: number } | null;
}

/** A camera's panel. */
export interface CameraProbe {
  name: string;
  shown: boolean;
  /** Pixels of the newest picture. */
  width: number;
  height: number;
  /** `null` before the first picture. */
  ageMs: number | null;
  /** Pictures shown since the session began, and pictures that could not be decoded. */
  pictures: number;
  failures: number;
}

/** A video's panel. */
export interface VideoProbe {
  name: string;
  /** What the robot encodes it with now; `null` before it has said so. */
  codec: VideoCodec | null;
  shown: boolean;
  /** Pixels of the newest frame. */
  width: number;
  height: number;
  /** `null` before the first frame. */
  ageMs: number | null;
  /** When the shown frame was captured, ms on the robot's clock; `null` before the first. */
  captureMs: number | null;
  /** Frames shown since the session began. */
  frames: number;
  /** The words in place of the video; `null` if nothing is wrong. */
  fault: string | null;
  enlarged: boolean;
  /** Whether it has changed places with the cloud. */
  fills: boolean;
}

/** What is heard of the robot, and whether it hears the operator. */
export interface SoundProbe {
  /** The words that the page shows about the robot's sound. */
  heard: { state: string; text: string };
  /** The words that the page shows about the operator's voice. */
  said: { state: string; text: string };
  /** Loudness of what has just been played, 0–1, and its strongest frequency, Hz. */
  level: number;
  peakHz: number | null;
  /** From the capture of what is being played to its handing over to the output, ms; `null` if it is not known. */
  delayMs: number | null;
  /** Whether this page's microphone is open. */
  sending: boolean;
}

/** How the headset shows the world. */
export interface HeadsetProbe {
  view: HeadsetView;
  /** Whether the operator's own room is behind the scene. */
  passthrough: boolean;
  /** Of the display, Hz. */
  frameRate: number | null;
  /** Where ahead in the operator's room points in the world, radians. */
  yaw: number;
  /** Place of the operator's eyes in the robot's world (REP-103), metres. */
  eyes: { x: number; y: number; z: number };
  /** To which side the robot's front is: −1 left, 1 right, 0 in view. */
  frontSide: number;
  /** How dark the edge of the view is, 0–1. */
  darkness: number;
  /** The world on the table: the robot's place in the room, metres, and metres in the room of one metre. */
  model: { x: number; y: number; z: number; scale: number };
  /** The sign before the eyes; `null` while it shows nothing. */
  notice: ShownNotice | null;
  /** Menu, labels and their places; `null` until their code is loaded. */
  console: ShownConsole | null;
}

export interface FarpointTestApi {
  readonly version: 1;
  state(): PageState;
  stats(): PageStats;
  /** Empties all distributions, so that they cover only what follows. */
  resetStats(): void;
  robots(): readonly RobotListing[];
  /**
   * Chooses a robot as a click in the list does. Resolves when the session is established; rejects after `timeoutMs`.
   */
  connect(robotId: string, timeoutMs?: number): Promise<void>;
  disconnect(): void;
  requestLease(take?: boolean): void;
  estop(latch: boolean): void;
  /** Runs a latency test as the L key does. Requests the lease first if nobody drives. Rejects with the reason. */
  latencyTest(): Promise<LatencyResult & { robot: LatencyFrame | null }>;
  /** All results since the page was loaded. */
  latencyResults(): readonly LatencyResult[];
  /** Holds the grip and the stick for `ms`; −1…1, forward and left positive. */
  drive(wish: { forward: number; left: number }, ms: number): Promise<void>;
  /** Holds the grip and the stick, as {@link drive} does, until it is called with `null`, but for a minute at most. */
  hold(wish: { forward: number; left: number } | null): void;
  /** Divides the link by these weights, until the page does so again. */
  shareLink(shares: { cloud: number; videos: readonly number[] }): void;
  probe(): DrawnProbe;
  /** The lines on the panel at the wrist; `null` outside VR. */
  wrist(): { text: string; tone: string }[] | null;
  /** `null` outside VR. */
  headset(): HeadsetProbe | null;
  cameras(): CameraProbe[];
  sound(): SoundProbe;
  videos(): VideoProbe[];
  /** Starts recording what videos show, for up to `capacity` presentations; `null` stops it. Needs `barcode=1`. */
  recordPresentations(capacity: number | null): void;
  /**
   * Of each recorded presentation: when its display frame was finished, the time that is drawn in each video's picture
   * (`null` if it cannot be read), and when the newest cloud beside them was captured; ms on the robot's clock.
   */
  recordedPresentations(): {
    finishedMs: number | null;
    drawnMs: (number | null)[];
    cloudMs: number | null;
  }[];
  /** The robot's clock now, as the page estimates it, ms; `null` until it is known. */
  robotNowMs(): number | null;
  /**
   * The canvas to which a video is drawn, by the video's number. It has the frame of {@link VideoProbe.captureMs} for as
   * long as the script runs without a pause, e.g. to read the frame's own time from its pixels.
   */
  videoCanvas(video: number): HTMLCanvasElement | null;
  /** The sensors of a robot with several: which should send clouds, and how many points of each are drawn. */
  sensors(): { name: string; wanted: boolean; points: number }[];
  /** Starts recording when packets arrive, for up to `capacity` packets; `null` stops it. */
  recordPackets(capacity: number | null): void;
  /**
   * Frame number, sequence offset and arrival of each recorded packet, one after another. Arrivals are in ms on the
   * robot's clock as the page estimates it, accurate to half of `minRttMs`.
   */
  recordedPackets(): { values: number[]; minRttMs: number | null };
  /** Starts recording anew how the robot obeys; `false` stops it. */
  recordDrive(on: boolean): void;
  recordedDrive(): DriveRecording | null;
}

declare global {
  interface Window {
    farpoint: FarpointTestApi;
  }
}
