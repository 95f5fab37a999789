/**
 * The page's conversation with a bridge, without a socket or a clock. The reference protocol has no lease, no emergency
 * stop, no limits and no telemetry. This class emulates them as far as the page's interface needs them. They hold for
 * this page only, and in case of doubt the robot stands still.
 */

import {
  type Command,
  decodeJson,
  encodeJson,
  isZeroTwist,
  NO_LEASE,
  type OperatorSessionMessage,
  PROTOCOL_VERSION,
  ProtocolError,
  type ReferenceBridgeToPage,
  type ReferencePageToBridge,
  type RobotListing,
  type RobotSessionMessage,
  referenceBridgeTelemetryCodec,
  referenceBridgeToPageCodec,
  referencePageToBridgeCodec,
  robotSessionCodec,
  zeroTwist,
} from '@farpoint/protocol';
import { STOP_REPEATS } from '../drive/command-stream.ts';
import type { SessionPhase } from '../session/session-keeper.ts';

export interface BridgeSessionActions {
  sendControl(text: string): void;
  sendTelemetry(text: string): void;
  onRobots(robots: readonly RobotListing[]): void;
  onPhase(phase: SessionPhase): void;
  /** From now on points come from another robot. */
  onBegin(): void;
  /** A message such as a Farpoint robot would send. */
  onRobotMessage(text: string): void;
  /** Within a session: no points arrive (`false`), or points arrive again (`true`). */
  onPath(up: boolean): void;
}

/** Assumed, because the robot does not send its limits. The reference system drives at 0.5 m/s. */
export const BRIDGE_LIMITS = { maxLinear: 0.5, maxAngular: 1, watchdogMs: 150, maxCommandsPerSecond: 100 };
/**
 * The page stops driving if no points have arrived for this long, ms. As long as a path of our own may be
 * silent (resume-policy.ts).
 */
const BLIND_AFTER_MS = 1000;
/**
 * A green frame is requested again after this time, ms: each request produces one. Chosen: above the round
 * trip of any link that can be driven by.
 */
const GREEN_AGAIN_MS = 500;

export class BridgeSession {
  readonly #actions: BridgeSessionActions;
  readonly #signaling: string | null;
  #phase: SessionPhase = 'none';
  #wanted: string | null = null;
  /** The wanted robot's name: its id changes each time it registers. */
  #wantedName: string | null = null;
  #robots: RobotListing[] = [];
  #open = false;
  #holdsLease = false;
  /** The emergency stop. It stays latched until released on purpose, even if the robot changes or comes back. */
  #stopped = false;
  /** The grip has been held ever since the stop was released. */
  #mustRest = false;
  #pathUp = true;
  #heardMs = 0;
  #green: { id: number; askedMs: number } | null = null;

  /** @param signaling the service that the bridge is to use; `null` leaves its choice unchanged */
  constructor(actions: BridgeSessionActions, signaling: string | null = null) {
    this.#actions = actions;
    this.#signaling = signaling;
  }

  get phase(): SessionPhase {
    return this.#phase;
  }
  get robotId(): string | null {
    return this.#wanted;
  }
  get robots(): readonly RobotListing[] {
    return this.#robots;
  }
  get robotListed(): boolean {
    return this.#robots.some(({ id }) => id === this.#wanted);
  }
  get interrupted(): boolean {
    return this.#phase === 'live' && !this.#pathUp;
  }
  silentMs(nowMs: number): number {
    return nowMs - this.#heardMs;
  }

  want(robotId: string | null): void {
    if (robotId === this.#wanted) return;
    if (this.#phase === 'live') this.#sayStop();
    this.#wanted = robotId;
    this.#wantedName = this.#nameOf(robotId);
    this.#enter(robotId === null ? 'none' : 'waiting');
    this.#choose();
  }

  /** @param open whether the control and telemetry sockets are both open */
  onSockets(open: boolean): void {
    this.#open = open;
    if (open) {
      // The bridge answers either message with the list.
      this.#control(
        this.#signaling === null ? { type: 'updateRobots' } : { type: 'initBridge', url: this.#signaling },
      );
      this.#choose();
      return;
    }
    // A different bridge may come back, with different ids.
    this.#setRobots([]);
    if (this.#phase !== 'none') this.#enter('waiting');
  }

  onControl(text: string, nowMs: number): void {
    let message: ReferenceBridgeToPage;
    try {
      message = decodeJson(referenceBridgeToPageCodec, text);
    } catch (error) {
      if (error instanceof ProtocolError) return;
      throw error;
    }
    if (message.type === 'updateRobots') {
      this.#setRobots(
        (message.robots ?? []).map(({ id, name }) => ({
          id: String(id),
          name: name.slice(0, 64) || 'Robot',
        })),
      );
      this.#wantedName ??= this.#nameOf(this.#wanted);
      const again = this.#robots.find(({ name }) => name === this.#wantedName);
      const isRenumbered = !this.robotListed && again !== undefined;
      if (isRenumbered) this.#wanted = again.id;
      if (this.#phase !== 'none' && (isRenumbered || !this.robotListed)) this.#enter('waiting');
      if (this.#phase === 'waiting') this.#choose();
    } else if (String(message.robotId) === this.#wanted) {
      // The robot is not in the list: it has left in the meantime.
      if (!this.robotListed) return;
      if (this.#phase !== 'live') this.#begin(nowMs);
    } else if (this.#wantedName !== null && this.#nameOf(String(message.robotId)) === this.#wantedName) {
      this.#wanted = String(message.robotId);
      this.#begin(nowMs);
    } else if (this.#phase === 'live') {
      // Another page chose another robot.
      this.#enter('waiting');
    }
  }

  onPoints(nowMs: number): void {
    this.#heardMs = nowMs;
    if (this.#phase !== 'live' || this.#pathUp) return;
    this.#pathUp = true;
    this.#actions.onPath(true);
  }

  /** Stops, and reports the path, once nothing is heard. */
  checkSilence(nowMs: number): void {
    if (this.#phase === 'live' && this.#pathUp && nowMs - this.#heardMs > BLIND_AFTER_MS) {
      this.#pathUp = false;
      this.#sayStop();
      this.#actions.onPath(false);
    }
  }

  command(command: Command, nowMs: number): void {
    // Nobody is told whether a hand is open.
    if (command.lease === NO_LEASE) return;
    if (this.#phase !== 'live' || this.interrupted) return;
    const { latencyTest } = command;
    if (latencyTest !== undefined) this.#askGreen(latencyTest, nowMs);
    if (isZeroTwist(command.twist) || !command.deadMan) this.#mustRest = false;
    const mayMove = this.#holdsLease && command.deadMan && !this.#stopped && !this.#mustRest;
    this.#say(mayMove ? command.twist : zeroTwist());
  }

  session(message: OperatorSessionMessage): void {
    if (this.#phase !== 'live') return;
    switch (message.type) {
      case 'leaseRequest':
        this.#setLease(true);
        break;
      case 'leaseRelease':
        this.#sayStop();
        this.#setLease(false);
        break;
      case 'estop':
        this.#stopped = message.latch;
        if (message.latch) this.#sayStop();
        else this.#mustRest = true;
        this.#tellEstop();
        break;
      case 'stream':
        break;
    }
  }

  #setRobots(robots: RobotListing[]): void {
    this.#robots = robots;
    this.#actions.onRobots(robots);
  }

  #nameOf(robotId: string | null): string | null {
    return this.#robots.find(({ id }) => id === robotId)?.name ?? null;
  }

  #choose(): void {
    if (!this.#open || this.#wanted === null || !this.robotListed || this.#phase === 'live') return;
    this.#enter('opening');
    this.#control({ type: 'switchRobot', robotId: Number(this.#wanted) });
  }

  #begin(nowMs: number): void {
    this.#heardMs = nowMs;
    this.#pathUp = true;
    this.#mustRest = false;
    this.#green = null;
    this.#actions.onBegin();
    this.#enter('live');
    const { id, name } = this.#robots.find((robot) => robot.id === this.#wanted) as RobotListing;
    this.#tell({
      type: 'welcome',
      protocol: PROTOCOL_VERSION,
      robotId: id,
      name,
      limits: BRIDGE_LIMITS,
      stream: { format: 'points64', width: 1, height: 1, framesPerSecond: 1 },
    });
    this.#setLease(false);
    this.#tellEstop();
  }

  #setLease(held: boolean): void {
    this.#holdsLease = held;
    this.#tell(
      held ? { type: 'lease', holder: 'you', lease: 'bridge' } : { type: 'lease', holder: 'nobody' },
    );
  }

  #tellEstop(): void {
    this.#tell(
      this.#stopped ? { type: 'estop', latched: true, by: 'operator' } : { type: 'estop', latched: false },
    );
  }

  #askGreen(id: number, nowMs: number): void {
    const asked = this.#green;
    if (asked !== null && asked.id === id && nowMs - asked.askedMs < GREEN_AGAIN_MS) return;
    this.#green = { id, askedMs: nowMs };
    const twist = zeroTwist();
    twist.linear.z = 1;
    this.#say(twist);
  }

  /** Sent several times: the channel beyond the bridge is reliable, but the socket may be gone. */
  #sayStop(): void {
    for (let i = 0; i < STOP_REPEATS; i++) this.#say(zeroTwist());
  }

  #say(twist: Command['twist']): void {
    this.#actions.sendTelemetry(
      encodeJson(referenceBridgeTelemetryCodec, { type: 'command', command: twist }),
    );
  }

  #control(message: ReferencePageToBridge): void {
    this.#actions.sendControl(encodeJson(referencePageToBridgeCodec, message));
  }

  #tell(message: RobotSessionMessage): void {
    this.#actions.onRobotMessage(encodeJson(robotSessionCodec, message));
  }

  #enter(phase: SessionPhase): void {
    if (phase === this.#phase) return;
    this.#phase = phase;
    this.#actions.onPhase(phase);
  }
}
