/** From the operator's hands to commands: which device drives, who may, what is sent when. Time is an argument. */
import type { Command, DriveLimits, LeaseState, OperatorSessionMessage } from '@farpoint/protocol';
import { CommandStream } from './command-stream.ts';
import { activeInput, type DriveInput } from './drive-input.ts';
import { REST } from './velocity-mapping.ts';

export interface DriverPort {
  sendCommand(command: Command): void;
  sendSession(message: OperatorSessionMessage): void;
  /** The grip was taken, but somebody else drives. */
  onOtherDrives(): void;
}

/** While the grip is held and nobody drives, the lease is asked for this often. */
const LEASE_RETRY_MS = 500;

/**
 * Turns the operator's hands into commands: chooses the device that drives, asks for the lease and decides what is sent when.
 * {@link RobotClient} makes one and calls it; an app reads {@link input} and {@link holder}.
 */
export class Driver {
  /** The commands that are sent. */
  readonly stream = new CommandStream();
  readonly #port: DriverPort;
  readonly #inputs: DriveInput[];
  #input: DriveInput | null = null;
  #holder: LeaseState['holder'] = 'nobody';
  #nextLeaseRequestMs = 0;
  #suspended = false;
  #toldOther = false;
  #mustOpen = false;

  /**
   * @param inputs devices that may drive; more can be added
   * @param port where commands and requests go
   */
  constructor(inputs: readonly DriveInput[], port: DriverPort) {
    this.#inputs = [...inputs];
    this.#port = port;
  }

  /** One more device that may drive. */
  add(input: DriveInput): void {
    this.#inputs.push(input);
  }

  /** The device that drives now; `null` where no grip is held. */
  get input(): DriveInput | null {
    return this.#input;
  }

  /** Who holds the lease, as the robot said last. */
  get holder(): LeaseState['holder'] {
    return this.#holder;
  }

  /** A session begins or ends: nothing is held any more. */
  reset(): void {
    this.stream.reset();
    this.#holder = 'nobody';
    this.#input = null;
    this.#toldOther = false;
  }

  /** The robot told its limits: wishes are scaled to them from now on. */
  onLimits(limits: DriveLimits): void {
    this.stream.setLimits(limits);
  }

  /** The robot told who drives. */
  onLease(lease: LeaseState): void {
    this.#holder = lease.holder;
    this.stream.setLease(lease.holder === 'you' ? (lease.lease ?? null) : null);
  }

  /** The page is hidden or lost the focus: whatever is held counts as let go. */
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

  /** Gives the lease back. */
  releaseLease(): void {
    this.#port.sendSession({ type: 'leaseRelease' });
  }

  /**
   * Stops and gives the lease back. What is held now counts as let go until every hand has been open once: it must not
   * move the next robot.
   *
   * @param nowMs `performance.now()`
   */
  letGo(nowMs: number): void {
    this.#mustOpen = true;
    this.tick(nowMs);
    if (this.#holder === 'you') this.releaseLease();
    // Zeros that came after the release would be refused.
    this.stream.setLease(null);
  }

  /**
   * The path to the robot is lost, or carries again. What is held counts as let go until every hand has been open once: a
   * hand that waited must not move the robot by itself.
   *
   * @param nowMs `performance.now()`
   */
  onPath(nowMs: number): void {
    this.#mustOpen = true;
    this.stream.restFirst();
    this.tick(nowMs);
  }

  /**
   * Reads the devices and sends what is due. Call it at the stream's rate, and at once when the grip or the stick changes.
   *
   * @param nowMs `performance.now()`
   */
  tick(nowMs: number): void {
    if (this.#mustOpen) this.#mustOpen = this.#inputs.some((input) => input.held);
    this.#input = this.#suspended || this.#mustOpen ? null : activeInput(this.#inputs, this.#input);
    const held = this.#input !== null;
    this.stream.set(held, this.#input?.wish ?? REST);
    if (held && this.#holder !== 'you') this.#ask(nowMs);
    if (!held) this.#toldOther = false;
    const command = this.stream.tick(nowMs);
    if (command !== null) this.#port.sendCommand(command);
  }

  #ask(nowMs: number): void {
    if (this.#holder === 'nobody') {
      if (nowMs < this.#nextLeaseRequestMs) return;
      this.#nextLeaseRequestMs = nowMs + LEASE_RETRY_MS;
      this.requestLease(false);
    } else if (!this.#toldOther) {
      // Taking over is asked for on purpose, by a button.
      this.#toldOther = true;
      this.#port.onOtherDrives();
    }
  }
}
