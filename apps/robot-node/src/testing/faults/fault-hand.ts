import {
  type Command,
  emptyPlacement,
  emptyPointPacketHeader,
  readCloudPayload,
  sequenceDelta32,
  zeroTwist,
} from '@farpoint/protocol';
import type { OperatorClient } from '../operator-client.ts';
import type { FaultyHand } from './fault.ts';

const COMMAND_MS = 20;
export const SPEED = 0.25;

/** A hand that holds on, whatever the robot says, and whose commands a fault can change. */
export class FaultHand implements FaultyHand {
  #alter: (command: Command) => Command | string | null = (command) => command;
  #speed = SPEED;
  #deadMan = true;
  /** The newest command that was made. */
  newest: Command | null = null;
  readonly #client: OperatorClient;
  readonly #lease: string;
  readonly #timer: NodeJS.Timeout;
  #sequence = 0;
  #seenUs: number | null = null;

  constructor(client: OperatorClient, lease: string) {
    this.#client = client;
    this.#lease = lease;
    const placement = emptyPlacement();
    const header = emptyPointPacketHeader();
    client.onCloudPacket = ({ buffer, byteOffset, byteLength }) => {
      readCloudPayload(new DataView(buffer, byteOffset, byteLength), header, placement);
      const { captureTimeUs } = placement;
      if (this.#seenUs === null || sequenceDelta32(captureTimeUs, this.#seenUs) > 0) this.#see(captureTimeUs);
    };
    this.#timer = setInterval(() => this.send(), COMMAND_MS);
  }

  /** @param alter what becomes of each command from now on before it is sent; `null`: nothing is sent */
  sends(alter: (command: Command) => Command | string | null): void {
    this.#alter = alter;
  }

  /** Sends nothing for a while, with the grip held. @returns the time between the two commands around it, ms */
  async pauses(ms: number): Promise<number> {
    const lastMs = this.newest?.timeMs ?? 0;
    this.#alter = () => null;
    await new Promise((resolve) => setTimeout(resolve, ms));
    this.#alter = (command) => command;
    this.send();
    return (this.newest?.timeMs ?? 0) - lastMs;
  }

  letGoOfStick(): void {
    this.#speed = 0;
  }

  make(): Command {
    const twist = this.#deadMan ? { ...zeroTwist(), linear: { x: this.#speed, y: 0, z: 0 } } : zeroTwist();
    return {
      type: 'command',
      sequence: this.#sequence++,
      timeMs: performance.now(),
      lease: this.#lease,
      deadMan: this.#deadMan,
      twist,
      ...(this.#seenUs === null ? {} : { seenUs: this.#seenUs }),
    };
  }

  send(): void {
    this.newest = this.make();
    const altered = this.#alter(this.newest);
    if (altered === null || this.#client.control.readyState !== 'open') return;
    this.#client.control.send(typeof altered === 'string' ? altered : JSON.stringify(altered));
  }

  /** Opens the hand for some commands, and grips again. */
  async gripAnew(): Promise<void> {
    this.#deadMan = false;
    for (let i = 0; i < 3; i++) this.send();
    await new Promise((resolve) => setTimeout(resolve, 3 * COMMAND_MS));
    this.#deadMan = true;
  }

  stop(): void {
    clearInterval(this.#timer);
  }

  #see(captureTimeUs: number): void {
    this.#seenUs = captureTimeUs;
  }
}
