/** Turns the operator's hands into commands: device, lease and timing. Time is an argument. */
import type { Command, LeaseState, OperatorSessionMessage, Welcome } from '@farpoint/protocol';
import { CommandStream } from './command-stream.ts';
import { activeInput, type DriveInput } from './drive-input.ts';
import { type GripLoss, Grips } from './grips.ts';
import { MissingGrip } from './missing-grip.ts';
import { REST } from './velocity-mapping.ts';

export interface DriverPort {
  sendCommand(command: Command): void;
  sendSession(message: OperatorSessionMessage): void;
  /** The grip was pressed, but somebody else drives. */
  onOtherDrives(): void;
  /** A grip that was held counts as released until it has been opened. */
  onGripLost?(loss: GripLoss): void;
  /** A stick is pushed, but the grip of its device is open. */
  onGripMissing?(device: DriveInput['name']): void;
}

/**
 * While the grip is held and nobody drives, the lease is requested at this interval, ms. Chosen: a lost
 * request costs half of a second; driver.test.ts holds it.
 */
const LEASE_RETRY_MS = 500;
/**
 * While nobody drives by this hand, the robot is told at this interval that it is open, ms (docs/safety.md).
 * Chosen: so long a first grip waits at most.
 */
const OPEN_HAND_MS = 500;

/**
 * Turns the operator's hands into commands: chooses the device that drives, requests the lease and decides what is sent
 * when. {@link RobotClient} creates and calls it; an app reads {@link input} and {@link holder}.
 */
export class Driver {
  /** The commands that are sent. */
  readonly stream = new CommandStream();
  /** Called for each command that leaves. */
  onCommand: ((command: Command) => void) | null = null;
  readonly #port: DriverPort;
  readonly #inputs: DriveInput[];
  #input: DriveInput | null = null;
  #holder: LeaseState['holder'] = 'nobody';
  #nextLeaseRequestMs = 0;
  #nextOpenHandMs = 0;
  #suspended = false;
  #toldOther = false;
  readonly #grips = new Grips();
  readonly #missing = new MissingGrip();
  readonly #holds = (input: DriveInput) => this.#grips.holds(input);

  /**
   * @param inputs devices that may drive; more can be added
   * @param port where commands and requests go
   */
  constructor(inputs: readonly DriveInput[], port: DriverPort) {
    this.#inputs = [...inputs];
    this.#port = port;
  }

  /** Adds a device that may drive. */
  add(input: DriveInput): void {
    this.#inputs.push(input);
  }

  /** The device that drives now; `null` if no grip is held. */
  get input(): DriveInput | null {
    return this.#input;
  }

  /** Whether the grip that drives was not read for a moment: the robot stands until it is, and then moves on. */
  get paused(): boolean {
    return this.#input !== null && this.#grips.isUnread(this.#input);
  }

  /** Why a grip that is held does not drive; `null` if there is none. It drives once it has been opened. */
  get lost(): GripLoss | null {
    for (const input of this.#inputs) {
      const loss = input.held ? this.#grips.lossOf(input) : null;
      if (loss !== null) return loss;
    }
    return null;
  }

  /** Whether a grip is held, also one that counts as released: a hand is on the stick. */
  get isGripped(): boolean {
    return this.#inputs.some(({ held }) => held);
  }

  /** Who holds the lease, by the robot's latest message. */
  get holder(): LeaseState['holder'] {
    return this.#holder;
  }

  /** A session begins or ends: all grips count as released. */
  reset(): void {
    this.stream.reset();
    this.#grips.lose(this.#inputs, 'let-go');
    this.#holder = 'nobody';
    this.#input = null;
    this.#toldOther = false;
  }

  /** The robot sent its limits: wishes are scaled to them from now on. */
  onLimits(limits: Welcome['limits']): void {
    this.stream.setLimits(limits);
    this.#grips.resumeWithinMs = limits.resumeWithinMs ?? 0;
  }

  /** The robot sent the state of the lease. */
  onLease(lease: LeaseState): void {
    this.#holder = lease.holder;
    this.stream.setLease(lease.holder === 'you' ? (lease.lease ?? null) : null);
  }

  /**
   * Whether the page is hidden or has lost the focus: all grips then count as released, and those that stay held do so
   * until they have been opened.
   */
  set suspended(suspended: boolean) {
    this.#suspended = suspended;
  }

  /**
   * Asks the robot for the lease.
   *
   * @param take whether to take it from another operator
   */
  requestLease(take: boolean): void {
    this.#port.sendSession({ type: 'leaseRequest', take });
  }

  /** Releases the lease. */
  releaseLease(): void {
    this.#port.sendSession({ type: 'leaseRelease' });
  }

  /**
   * Stops and releases the lease. Each grip that is held counts as released until it has been opened: it must not move
   * the next robot.
   *
   * @param nowMs `performance.now()`
   */
  letGo(nowMs: number): void {
    this.#grips.lose(this.#inputs, 'let-go');
    this.sendDue(nowMs);
    if (this.#holder === 'you') this.releaseLease();
    // The robot would reject zero commands that arrive after the release.
    this.stream.setLease(null);
  }

  /**
   * The path to the robot is lost or restored. Each grip that is held counts as released until it has been opened: the
   * robot must not start to move because a grip was held during the outage.
   *
   * @param nowMs `performance.now()`
   */
  onPath(nowMs: number): void {
    this.#grips.lose(this.#inputs, 'path-lost');
    this.stream.restFirst();
    this.sendDue(nowMs);
  }

  /**
   * Another operator has handed the drive to this one. Each grip that is held counts as released until it has been opened,
   * and the robot is shown that: it demands it.
   *
   * @param nowMs `performance.now()`
   */
  onHandedOver(nowMs: number): void {
    this.#grips.lose(this.#inputs, 'other-drives');
    this.stream.showOpen();
    this.sendDue(nowMs);
  }

  /**
   * Takes the devices' states and sends what is due. Call it at the stream's rate, and at once when a grip or stick
   * changes. A grip whose device was not read for 100 ms moves nothing until it is read again, and counts as released if
   * that takes longer than the robot allows.
   *
   * @param nowMs `performance.now()`
   */
  sendDue(nowMs: number): void {
    const lost = this.#grips.update(this.#inputs, nowMs, this.#suspended);
    if (lost !== null) this.#port.onGripLost?.(lost);
    const open = this.#suspended ? null : this.#missing.update(this.#inputs, nowMs);
    if (open !== null) this.#port.onGripMissing?.(open.name);
    this.#input = activeInput(this.#inputs, this.#input, this.#holds);
    const held = this.#input !== null;
    const hand = !held ? 'open' : this.paused ? 'unread' : 'held';
    this.stream.set(hand, this.#input?.wish ?? REST, this.#input?.readMs ?? null);
    if (held && this.#holder !== 'you') this.#ask(nowMs);
    if (!held) this.#toldOther = false;
    this.#tellOpenHand(nowMs);
    const command = this.stream.due(nowMs);
    if (command === null) return;
    this.#port.sendCommand(command);
    this.onCommand?.(command);
  }

  /** A command may be lost, so it is told again. */
  #tellOpenHand(nowMs: number): void {
    if (nowMs < this.#nextOpenHandMs || this.isGripped) return;
    const command = this.stream.openHand(nowMs);
    if (command === null) return;
    this.#nextOpenHandMs = nowMs + OPEN_HAND_MS;
    this.#port.sendCommand(command);
  }

  #ask(nowMs: number): void {
    if (this.#holder === 'nobody') {
      if (nowMs < this.#nextLeaseRequestMs) return;
      this.#nextLeaseRequestMs = nowMs + LEASE_RETRY_MS;
      this.requestLease(false);
    } else if (!this.#toldOther) {
      // Taking over from another operator needs a deliberate act, a button.
      this.#toldOther = true;
      this.#port.onOtherDrives();
      // It must not start the robot when that other one leaves.
      this.#grips.lose(this.#inputs, 'other-drives');
    }
  }
}
