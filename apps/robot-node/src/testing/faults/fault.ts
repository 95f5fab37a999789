import { type Command, zeroTwist } from '@farpoint/protocol';
import type { SignaledOperator } from '../signaled-operator.ts';
import type { FaultHand } from './fault-hand.ts';
import type { FaultRig } from './fault-rig.ts';

/** The most from a cause to braking, ms. A link's own delay is added where there is one. */
export const BRAKES_MS = 200;
/**
 * For causes that only what the driver sees can tell: 150 ms, one frame of the camera, and two commands; or 100 ms, one
 * frame at the lowest rate, and one command.
 */
export const VIEW_MS = 225;

/** A robot that is being driven, with the grip held. */
export interface Driving {
  rig: FaultRig;
  operator: SignaledOperator;
  hand: FaultHand;
}

/** Something that goes wrong. */
export interface Fault {
  name: string;
  /** ms; default {@link BRAKES_MS}. */
  withinMs?: number;
  behindLink?: boolean;
  /** Whether the robot must know the usual interval of what the driver sees: its last second counts. */
  settled?: boolean;
  /** May say when it began, `performance.now()`, if preparing it took long. */
  cause(driving: Driving): unknown;
}

/** Changes parts of each command. */
export const change = (more: (command: Command) => Partial<Command>) => (command: Command) => ({
  ...command,
  ...more(command),
});
export const forward = (x: number) => ({ ...zeroTwist(), linear: { x, y: 0, z: 0 } });
/** Sends this in place of each command. */
export const always = (text: string) => () => text;
