import type { DriveInput, DriveWish } from '@farpoint/operator';
import type { Command } from '@farpoint/protocol';

/** An operator's hand at a device that is read all the time, and what a fault makes of the commands that it gives. */
export class Hand implements DriveInput {
  readonly name = 'gamepad';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  held = false;
  /** Whether the device is read. */
  isRead = true;
  /** The newest command that was made. */
  newest: Command | null = null;
  #alter: (command: Command) => Command | string | null = (command) => command;
  #readMs = 0;

  get readMs(): number {
    if (this.isRead) this.#readMs = performance.now();
    return this.#readMs;
  }

  /** Holds the grip, and pushes the stick: −1 to 1. */
  push(forward: number, left = 0, sideways = 0): void {
    [this.held, this.wish.forward, this.wish.left, this.wish.sideways] = [true, forward, left, sideways];
  }

  letGo(): void {
    this.held = false;
  }

  /** @param alter what becomes of each command from now on before it is sent; `null`: nothing is sent */
  sends(alter: (command: Command) => Command | string | null): void {
    this.#alter = alter;
  }

  /** What becomes of a command that is to be sent. */
  made(command: Command): Command | string | null {
    this.newest = command;
    return this.#alter(command);
  }
}
