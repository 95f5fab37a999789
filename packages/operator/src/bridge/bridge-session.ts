/**
 * What the page says to a bridge and hears of it, without a socket or a clock. The reference protocol has no lease, no
 * emergency stop, no limits and no telemetry: what the page's surface needs of them is made here, for this page alone, and
 * always on the side of standing still.
 */
import {
  type Command,
  decodeJson,
  encodeJson,
  isZeroTwist,
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
import type { SessionPhase } from '../session/session-keeper.ts';

export interface BridgeSessionActions {
  sendControl(text: string): void;
  sendTelemetry(text: string): void;
  onRobots(robots: readonly RobotListing[]): void;
  onPhase(phase: SessionPhase): void;
  /** Another robot's points come from now on. */
  onBegin(): void;
  /** As a robot of Farpoint's would have told it. */
  onRobotMessage(text: string): void;
  /** Within a session: no points come (`false`), or some do again. */
  onPath(up: boolean): void;
}

/** Nobody tells them; the robot has its own. The reference system drives at half a metre a second. */
export const BRIDGE_LIMITS = { maxLinear: 0.5, maxAngular: 1, watchdogMs: 150, maxCommandsPerSecond: 100 };
/** Who sees nothing new does not drive, ms. */
const BLIND_AFTER_MS = 1000;
/** A green frame is asked for again after so long, ms: each request makes one. */
const GREEN_AGAIN_MS = 500;
const STOP_REPEATS = 4;

export class BridgeSession {
  readonly #actions: BridgeSessionActions;
  readonly #signaling: string | null;
  #phase: SessionPhase = 'none';
  #wanted: string | null = null;
  /** The same robot is known by another id each time it registers. */
  #wantedName: string | null = null;
  #robots: RobotListing[] = [];
  #open = false;
  #holdsLease = false;
  /** Until it is released on purpose, whichever robot is shown and however often it comes back. */
  #stopped = false;
  /** Since the stop was released the hand has not been open. */
  #mustRest = false;
  #pathUp = true;
  #heardMs = 0;
  #green: { id: number; askedMs: number } | null = null;

  /** @param signaling which service the bridge is to use; `null`: the one that it uses */
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

  /** Both the control and the telemetry socket are open, or no longer. */
  onSockets(open: boolean): void {
    this.#open = open;
    if (open) {
      // Either is answered by the list.
      this.#control(
        this.#signaling === null ? { type: 'updateRobots' } : { type: 'initBridge', url: this.#signaling },
      );
      this.#choose();
      return;
    }
    // Another bridge may come back in its place, with other ids.
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
      // Not in the list: it has left meanwhile.
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

  tick(nowMs: number): void {
    if (this.#phase === 'live' && this.#pathUp && nowMs - this.#heardMs > BLIND_AFTER_MS) {
      this.#pathUp = false;
      this.#sayStop();
      this.#actions.onPath(false);
    }
  }

  command(command: Command, nowMs: number): void {
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

  /** The channel beyond the bridge is reliable, the socket may not be there any more: several times. */
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
