/** Where the time of each command goes, from the operator's hand to the robot's drive. No clock here. */
import type { CommandTimes } from '@farpoint/protocol';
import type { AgeOfStamp } from './frame-latency.ts';
import { StageWindow } from './stage-window.ts';

/** The stages of a command, in their order. */
export const commandStages = [
  'hand', // from the reading of the device to the command
  'page', // until it was handed to the connection
  'link', // until the robot had it
  'gate', // until the drive guard had judged it
  'wheels', // until the drive had the velocity that follows from it
] as const;
/**
 * A stage of a command.
 *
 * @useDeclaredType
 */
export type CommandStage = (typeof commandStages)[number];

/** Commands that are kept: 30 s at 100 a second, the most that a robot reads by default. */
const MOST_COMMANDS = 3072;

/** Joins what the robot tells of commands with when they were made and sent. */
export class CommandStages {
  /** The latest commands. */
  readonly window = new StageWindow(commandStages, MOST_COMMANDS);
  /** Commands that the robot has refused, since the session began: they have no time to the wheels, and no total. */
  refused = 0;
  readonly #ageOf: AgeOfStamp;

  /** @param ageOf the age of a timestamp of the robot's clock, ms */
  constructor(ageOf: AgeOfStamp) {
    this.#ageOf = ageOf;
  }

  /** A new session: its commands are counted anew. */
  clear(): void {
    this.window.clear();
    this.refused = 0;
  }

  /** A command was sent. Times are `performance.now()`. @param handMs when the device was read */
  onSent(sequence: number, handMs: number, madeMs: number, sentMs: number): void {
    const slot = this.window.add(sequence, 0, sentMs, Number.NaN);
    this.window.set(slot, 'hand', madeMs - handMs);
    this.window.set(slot, 'page', sentMs - madeMs);
  }

  /** The robot has told the times of a command. @param nowMs when it did, `performance.now()` */
  onTimes([sequence, receivedUs, judgedUs, wheelsUs]: Readonly<CommandTimes>, nowMs: number): void {
    const { window } = this;
    const slot = window.find(sequence, 0);
    if (slot < 0) return;
    const sentMs = window.endedMs(slot);
    const linkMs = nowMs - (this.#ageOf(receivedUs, nowMs) ?? Number.NaN) - sentMs;
    const robotMs = (wheelsUs ?? Number.NaN) / 1000;
    if (wheelsUs === null) this.refused++;
    window.set(slot, 'link', linkMs);
    window.set(slot, 'gate', judgedUs / 1000);
    window.set(slot, 'wheels', robotMs - judgedUs / 1000);
    window.tell(slot, window.get(slot, 'hand') + window.get(slot, 'page') + linkMs + robotMs);
  }
}
