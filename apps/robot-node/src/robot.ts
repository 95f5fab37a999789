import type { TimedBaseState } from '@farpoint/cloud-source';
import type { Logger } from '@farpoint/service';
import { SignalingClient } from './admit/signaling/signaling-client.ts';
import type { DriveCore } from './drive-core.ts';
import { monotonicMs } from './ground/clock.ts';
import { RobotCounters } from './ground/robot-counters.ts';
import type { DriveStation } from './motion/drive/drive-station.ts';
import type { Drive } from './motion/open-drive.ts';
import { type RobotStops, startStops } from './motion/stops/robot-stops.ts';
import type { RobotOptions } from './program/robot-configuration.ts';
import * as link from './robot-links.ts';
import { openParts, type RobotParts } from './robot-parts.ts';
import type { ReferenceProfile } from './serve/reference/reference-profile.ts';
import type { RobotStreams, StreamsAudience } from './serve/robot-streams.ts';
import type { OperatorSession } from './serve/session/operator-session.ts';
import type { OperatorSessions } from './serve/session/operator-sessions.ts';
import type { RobotReports } from './tell/robot-reports.ts';

/**
 * How often budgets, sessions and stops are brought up to date, ms: as often as the rate controller wants to
 * be asked (docs/congestion.md).
 */
const UPDATE_EVERY_MS = 25;

/** The complete robot: a base, a velocity sink, sensors, operators, and one guard over the wheels. */
export class Robot implements StreamsAudience {
  /** What was opened before: sources, wheels, guard, recording. */
  readonly parts: RobotParts;
  /** Clouds, pictures, videos and sound. */
  readonly streams: RobotStreams;
  readonly sessions: OperatorSessions;
  readonly stops: RobotStops;
  readonly signaling: SignalingClient;
  readonly counters = new RobotCounters();
  /** The interface to the reference system's operators; `null` if it is not enabled. */
  reference: ReferenceProfile | null = null;
  /** Called if the robot cannot continue. */
  onFailure: ((error: Error) => void) | null = null;
  readonly #context: link.RobotContext;
  readonly #core: DriveCore;
  readonly #reports: RobotReports;
  readonly #endListing: () => void;
  readonly #updating: NodeJS.Timeout;
  #state: TimedBaseState | null = null;
  /** When the first sensor's capture thread last gave a sign of life, ms on the robot's clock. */
  #captureSeenMs: number | null = null;

  private constructor(parts: RobotParts, options: RobotOptions, log: Logger) {
    const { id, name, stops } = options;
    this.parts = parts;
    this.signaling = new SignalingClient({ id, name, ...options.signaling }, log);
    const context = link.openContext(options, parts, this, log);
    this.#context = context;
    const onFailure = (error: Error) => this.onFailure?.(error);
    const onState = (state: TimedBaseState) => {
      this.#state = state;
    };
    this.streams = link.linkStreams(context, this, {
      host: () => this.#core.host,
      onState: (state) => {
        this.#captureSeenMs = state.timeMs;
        if (parts.base === null) onState(this.driving.odometry.take(state));
      },
      onFailure,
    });
    this.#core = link.linkCore(context, this.streams, this);
    this.sessions = link.linkSessions(context, this.streams, this.#core);
    this.signaling.onMessage = (message) => this.sessions.onSignaling(message);
    const addReading = link.linkReadings(context, this.driving, { onState, onFailure });
    const { heldBy } = this.driving.estop.start;
    this.stops = startStops(stops, this.#core.host, heldBy, addReading, log);
    const state = () => this.#state;
    this.#reports = link.linkReports(context, this.driving, this.operators, state);
    this.#endListing = link.linkListedStatus(context, this.driving, this.operators, state);
    this.#updating = setInterval(() => this.#update(), UPDATE_EVERY_MS);
  }

  /** Opens the sources and connects to the signaling service. @throws {CaptureError} if a source cannot be opened */
  static async start(options: RobotOptions, log: Logger, audit: RobotParts['audit']): Promise<Robot> {
    const robot = new Robot(await openParts(options, log, audit), options, log);
    robot.signaling.start();
    robot.streams.broadcast?.start();
    robot.reference = link.linkReference(robot.#context, robot.streams, robot.#core);
    return robot;
  }

  get operators(): ReadonlyMap<string, OperatorSession> {
    return this.sessions.operators;
  }

  /** Who drives; `null` if nobody does. */
  get driver(): string | null {
    return this.drive.guard.leaseHolder;
  }

  get driving(): Drive {
    return this.#core.driving;
  }

  get drive(): DriveStation {
    return this.driving.station;
  }

  /** What exports spans; `null` if nothing does. */
  get spans(): link.RobotContext['spans'] {
    return this.#context.spans;
  }

  /** Time since the capture thread last gave a sign of life, ms; 0 before the first. */
  get captureSilenceMs(): number {
    return this.#captureSeenMs === null ? 0 : monotonicMs() - this.#captureSeenMs;
  }

  #update(): void {
    this.#core.update();
    this.sessions.update();
    this.reference?.update();
    this.streams.update();
  }

  /**
   * Stops the wheels first, then ends all sessions and closes everything.
   *
   * @param isAsked whether somebody wants it to end. After any other end, the next start begins with the emergency stop latched
   */
  async close(isAsked = true): Promise<void> {
    if (isAsked) this.driving.estop.end();
    this.drive.guard.latchEstop('robot');
    this.drive.halt();
    clearInterval(this.#updating);
    this.#endListing();
    await this.sessions.closeCommands();
    const reported = this.#reports.close();
    this.sessions.close();
    this.reference?.close();
    this.drive.close();
    await link.closeLinked(this.#context, this.streams, this.driving, this.stops);
    await reported;
  }
}
