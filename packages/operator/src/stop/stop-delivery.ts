/**
 * Gets a press of STOP to the robot: at once on two channels, again until the robot acknowledges it, and after the link's
 * return if there is none. Time is an argument.
 */
import { type EstopState, nextSequence32, sequenceDelta32 } from '@farpoint/protocol';
import type { RobotLink } from '../link/robot-link.ts';

/** What has become of the newest press of STOP. */
export type StopStatus =
  | 'none' // nothing was pressed, or what was has been released since
  | 'unconfirmed' // sent, or kept until it can be; the robot has not confirmed it
  | 'confirmed' // the robot has latched its emergency stop
  | 'undelivered'; // given up: never confirmed in time, or another robot was chosen

/** What a press is sent with. */
export type StopLink = Pick<
  RobotLink,
  'phase' | 'interrupted' | 'robotId' | 'session' | 'sendSession' | 'sendControl'
>;

/**
 * A press that the robot has not acknowledged is repeated on `control` at this interval, ms. Chosen: a lost
 * one costs 50 ms, 5 cm at 1 m/s; stop-delivery.test.ts holds it.
 */
const REPEAT_MS = 50;
/** While nothing is heard, the other direction may still work; but what cannot leave must not pile up. */
const REPEAT_INTERRUPTED_MS = 500;
/**
 * A press is kept for this long. One that arrived still later would stop a robot that nobody expects to stop.
 * As long as both sides keep a silent session (session-keeper.ts).
 */
export const STOP_KEPT_MS = 60_000;

interface Pending {
  readonly press: number;
  /** A press means this robot and no other. */
  readonly robotId: string;
  readonly sinceMs: number;
  repeatMs: number;
  /** The session on whose reliable channel it was sent, without and with its number. */
  sentPlain: object | null;
  sentNumbered: object | null;
}

/** Delivers STOP. {@link RobotClient} creates and calls it; an app reads {@link status}. */
export class StopDelivery {
  readonly #link: StopLink;
  readonly #onStatus: (status: StopStatus) => void;
  #press = 0;
  #pending: Pending | null = null;
  #status: StopStatus = 'none';

  /** @param onStatus called when the status changes */
  constructor(link: StopLink, onStatus: (status: StopStatus) => void) {
    this.#link = link;
    this.#onStatus = onStatus;
  }

  /** What has become of the newest press. */
  get status(): StopStatus {
    return this.#status;
  }

  /**
   * STOP is pressed. Each press is a new one, whatever became of earlier ones.
   *
   * @param nowMs `performance.now()`
   * @returns false if no robot is chosen
   */
  press(nowMs: number): boolean {
    const { robotId } = this.#link;
    if (robotId === null) return false;
    this.#press = nextSequence32(this.#press);
    this.#pending = {
      press: this.#press,
      robotId,
      sinceMs: nowMs,
      repeatMs: nowMs,
      sentPlain: null,
      sentNumbered: null,
    };
    this.#set('unconfirmed');
    this.sendDue(nowMs);
    return true;
  }

  /** Sends what is due. Call it at least every 50 ms. @param nowMs `performance.now()` */
  sendDue(nowMs: number): void {
    const pending = this.#pending;
    if (pending === null) return;
    if (this.#link.robotId !== pending.robotId || nowMs - pending.sinceMs >= STOP_KEPT_MS) {
      this.#pending = null;
      this.#set('undelivered');
    } else if (this.#link.phase === 'live') this.#send(pending, nowMs);
  }

  /** The robot acknowledged a press. */
  onAck(press: number): void {
    if (this.#pending === null || !covers(press, this.#pending.press)) return;
    this.#pending = null;
    this.#set('confirmed');
  }

  /** The robot sent the state of its emergency stop. */
  onState({ latched, latch, press }: EstopState): void {
    // A robot that does not number its latches acknowledges by being latched.
    const confirms = latch === undefined ? latched : press !== undefined && covers(press, this.#press);
    if (this.#pending !== null && confirms) this.onAck(this.#press);
    const isLater = latch === undefined || (press !== undefined && covers(press, this.#press));
    if (this.#status === 'confirmed' && !latched && isLater) this.#set('none');
  }

  /** Another session begins. What was confirmed in the last one says nothing about this one. */
  onSession(): void {
    if (this.#status === 'confirmed') this.#set('none');
  }

  #send(pending: Pending, nowMs: number): void {
    const { session, interrupted } = this.#link;
    const { press } = pending;
    // Robots that do not number latches would refuse a numbered press. Until this session's robot has shown that it does,
    // a plain one is sent, which every robot reads.
    if (session.estop.latch === undefined) {
      if (pending.sentPlain === session) return;
      pending.sentPlain = session;
      this.#link.sendSession({ type: 'estop', latch: true });
      return;
    }
    if (pending.sentNumbered !== session) {
      pending.sentNumbered = session;
      pending.repeatMs = nowMs;
      this.#link.sendSession({ type: 'estop', latch: true, press });
    }
    if (nowMs < pending.repeatMs) return;
    pending.repeatMs = nowMs + (interrupted ? REPEAT_INTERRUPTED_MS : REPEAT_MS);
    this.#link.sendControl({ type: 'estop', press });
  }

  #set(status: StopStatus): void {
    if (status === this.#status) return;
    this.#status = status;
    this.#onStatus(status);
  }
}

/** Whether an acknowledgement of one press also acknowledges another: it does so for all earlier ones. */
function covers(acknowledged: number, press: number): boolean {
  return sequenceDelta32(acknowledged, press) >= 0;
}
