import {
  type Command,
  type EstopRequest,
  type RobotSessionMessage,
  sequenceDelta32,
  type Twist,
  zeroTwist,
} from '@farpoint/protocol';

export interface DriveExtras {
  latencyTest?: number;
  seenUs?: number | undefined;
  twist?: Twist;
  deadMan?: boolean;
}

/** The hand of an operator for tests: makes its commands, and lets go once when the robot asks for it. */
export class DrivingHand {
  readonly #heard: readonly RobotSessionMessage[];
  /** How many of the robot's messages have been looked at. */
  #seen = 0;
  #sequence = 0;
  #seenUs: number | null = null;

  /** @param heard the robot's messages on `session`; more are appended as they come */
  constructor(heard: readonly RobotSessionMessage[]) {
    this.#heard = heard;
  }

  /** Whatever has arrived counts as drawn at once. @param stampUs its capture time, as in `seenUs` */
  sees(stampUs: number): void {
    if (this.#seenUs === null || sequenceDelta32(stampUs, this.#seenUs) > 0) this.#seenUs = stampUs;
  }

  /** On a busy machine commands come with gaps, after which the robot demands an open hand. */
  command(lease: string, linear: number, more: DriveExtras): Command {
    const news = this.#heard.slice(this.#seen);
    this.#seen = this.#heard.length;
    const letsGo = news.some((each) => each.type === 'rejected' && each.reason === 'let-go-first');
    return {
      type: 'command',
      sequence: this.#sequence++,
      timeMs: performance.now(),
      lease,
      deadMan: true,
      twist: { ...zeroTwist(), linear: { x: linear, y: 0, z: 0 } },
      ...(this.#seenUs === null ? {} : { seenUs: this.#seenUs }),
      ...more,
      ...(letsGo ? { twist: zeroTwist() } : {}),
    };
  }
}

/** A release that names the latch of which the robot spoke last. */
export function namedRelease(heard: readonly RobotSessionMessage[]): EstopRequest {
  const state = heard.findLast((message) => message.type === 'estop');
  return { type: 'estop', latch: false, of: state?.latch };
}
