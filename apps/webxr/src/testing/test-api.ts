/**
 * `window.farpoint`: what end-to-end tests and benchmarks see of the page, and do with it. Times in ms, rates a second.
 * It can do nothing that the page's own controls cannot.
 */
import type {
  LatencyResult,
  LeaseState,
  RobotListing,
  SessionLoss,
  SessionPhase,
  SignalingState,
} from '@farpoint/operator';
import type { DriveState, LatencyFrame } from '@farpoint/protocol';
import type { PageStats } from '../status/page-stats.ts';

export interface PageState {
  signaling: SignalingState;
  session: SessionPhase;
  /** Sessions that came to stand since the page was loaded. */
  sessionsOpened: number;
  lastLoss: SessionLoss | null;
  robotId: string | null;
  robotListed: boolean;
  /** The line that the page shows about the link. */
  link: string;
  /** The last thing the page told: refusals, failures. */
  notice: string | null;
  holder: LeaseState['holder'];
  estop: boolean;
  drive: DriveState | null;
  battery: number | null;
  /** base_link in the world, REP-103: metres, radians. */
  body: { x: number; y: number; z: number; yaw: number } | null;
  /** m/s and rad/s, as the robot measures. */
  velocity: { linear: number; angular: number } | null;
  /** Sending commands now, and by which device. */
  driving: boolean;
  input: string | null;
  vr: boolean;
}

export type { PageStats };

/** What is drawn now. */
export interface DrawnProbe {
  /** Points drawn, and those of them in the latency test's green. */
  points: number;
  green: number;
  /** Of the drawn points in the world (REP-103), metres. */
  bounds: { min: [number, number, number]; max: [number, number, number] } | null;
  /** Where the newest frame's camera stood, metres. */
  camera: { x: number; y: number; z: number; yaw: number } | null;
  newestFrame: number | null;
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
  /** Shown since the session began, and those that could not be decoded. */
  pictures: number;
  failures: number;
}

export interface FarpointTestApi {
  readonly version: 1;
  state(): PageState;
  stats(): PageStats;
  /** Forgets all distributions, so that what follows is measured by itself. */
  resetStats(): void;
  robots(): readonly RobotListing[];
  /** As choosing the robot in the list. Resolves when its session stands; rejects after `timeoutMs`. */
  connect(robotId: string, timeoutMs?: number): Promise<void>;
  disconnect(): void;
  requestLease(take?: boolean): void;
  estop(latch: boolean): void;
  /** As pressing L. Asks for the lease first where nobody drives. Rejects with the reason. */
  latencyTest(): Promise<LatencyResult & { robot: LatencyFrame | null }>;
  /** Every result since the page was loaded. */
  latencyResults(): readonly LatencyResult[];
  /** As holding the grip and the stick for so long; −1…1, forward and left positive. */
  drive(wish: { forward: number; left: number }, ms: number): Promise<void>;
  /** Limits the stream, bit/s (the `bandwidth` channel). */
  limitBandwidth(bitsPerSecond: number): void;
  probe(): DrawnProbe;
  cameras(): CameraProbe[];
  /** Of a robot with several sensors: whose clouds are wanted, and how many points of each are drawn. */
  sensors(): { name: string; wanted: boolean; points: number }[];
  /** Begins to record when each packet arrives, up to so many; `null` ends it. */
  recordPackets(capacity: number | null): void;
  /**
   * Frame number, sequence offset and arrival of each recorded packet, one after another. Arrivals in ms of the robot's
   * clock as the page knows it, right to half of `minRttMs`.
   */
  recordedPackets(): { values: number[]; minRttMs: number | null };
  /** Colour of one pixel after the next display frame, x and y as shares of the canvas from its top left. */
  pixel(x: number, y: number): Promise<[number, number, number]>;
}

declare global {
  interface Window {
    farpoint: FarpointTestApi;
  }
}
