import {
  type Command,
  type OperatorControlMessage,
  type OperatorSessionMessage,
  zeroTwist,
} from '@farpoint/protocol';

/** The most from a cause to braking, ms. A link's own delay is added where there is one. */
export const BRAKES_MS = 200;
/** For causes that only what the driver sees can tell: 150 ms, one frame of the camera, and two commands. */
export const VIEW_MS = 225;

/** `up` is from the robot to the operator. */
type OfDirection = { direction: 'up' | 'down' | 'both' };
/** A change of the link between the two. */
export type LinkChange =
  /** Drops every packet. */
  | (OfDirection & { type: 'blackhole'; active: boolean })
  /** Lets every packet wait. */
  | (OfDirection & { type: 'pause'; paused: boolean })
  | (OfDirection & { type: 'set'; delayMs?: number; jitterMs?: number; loss?: number; rateMbps?: number });

/** The link of an operator. */
export interface FaultLink {
  tell(change: LinkChange): void;
  /** The operator's network gives it other addresses. */
  renumber(): unknown;
}

/** An operator in whose hand, page or machine something goes wrong. */
export interface FaultOperator {
  sendSession(message: OperatorSessionMessage): void;
  sendControl(message: OperatorControlMessage): void;
  /** Sends this on the control channel, whatever it is. */
  sendText(text: string): void;
  closeControl(): void;
  /** Disappears without a word. */
  vanish(): unknown;
  close(): unknown;
  /** Asks for the release of the emergency stop, as it is known to this operator. */
  releaseEstop(): void;
  /** Resolves once the robot has said that its emergency stop is so. */
  estop(latched: boolean): Promise<unknown>;
}

/** A hand that holds on, and whose commands a fault can change. */
export interface FaultyHand {
  /** The newest command that was made. */
  readonly newest: Command | null;
  /** The command that comes next. */
  make(): Command;
  /** @param alter what becomes of each command from now on before it is sent; `null`: nothing is sent */
  sends(alter: (command: Command) => Command | string | null): void;
  letGoOfStick(): void;
}

/** A robot with a camera, and operators. Real programs, or everything in virtual time. */
export interface FaultyRobot {
  readonly link: FaultLink | null;
  /** Another operator. */
  connect(): Promise<FaultOperator>;
  startCamera(): void;
  stopCamera(): void;
}

/** A robot that is being driven, with the grip held. */
export interface Driving {
  rig: FaultyRobot;
  operator: FaultOperator;
  hand: FaultyHand;
}

/** Something that goes wrong. */
export interface Fault<Driven extends Driving = Driving> {
  name: string;
  /** ms; default {@link BRAKES_MS}. */
  withinMs?: number;
  behindLink?: boolean;
  /** Whether the robot must know the usual interval of what the driver sees: its last second counts. */
  settled?: boolean;
  /** May say when it began, `performance.now()`, if preparing it took long. */
  cause(driving: Driven): unknown;
}

/** Changes parts of each command. */
export const change = (more: (command: Command) => Partial<Command>) => (command: Command) => ({
  ...command,
  ...more(command),
});
export const forward = (x: number) => ({ ...zeroTwist(), linear: { x, y: 0, z: 0 } });
/** The command with something else in place of its velocity ahead. */
export const withVelocity = (text: string) => (command: Command) =>
  JSON.stringify(command).replace(/"x":[^,]+/, `"x":${text}`);
/** Sends this in place of each command. */
export const always = (text: string) => () => text;
