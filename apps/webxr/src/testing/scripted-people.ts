/** The other people at a scripted robot: who is here, and what becomes of requests for the drive and offers of it. */
import type { ToldMessage } from '@farpoint/operator/testing/scripted-link';
import {
  HANDOVER_MS,
  type Handover,
  type HandoverEnd,
  type LeaseState,
  type PresentOperator,
} from '@farpoint/protocol';

/** What people are at. */
export interface PeopledRobot {
  readonly lease: LeaseState;
  tell(message: ToldMessage): void;
  /** Somebody has the lease now. */
  giveLease(holder: LeaseState['holder'], driver?: string): void;
}

type Open = Omit<Handover, 'leftMs' | 'ended'>;

export class ScriptedPeople {
  /** In the order in which they are listed, the page's operator first; empty: the robot does not say who is here. */
  here: readonly Omit<PresentOperator, 'drives'>[] = [];
  /** For how long the driver has driven, seconds. */
  drivesForS = 0;
  readonly #robot: PeopledRobot;
  #open: Open | null = null;
  #ends: ReturnType<typeof setTimeout> | undefined;
  #id = 0;

  constructor(robot: PeopledRobot) {
    this.#robot = robot;
  }

  /** The list of who is here is told. */
  list(): void {
    if (this.here.length === 0) return;
    const { holder } = this.#robot.lease;
    const driver = this.#driver?.number;
    const operators = this.here.map((each) => ({ ...each, drives: each.number === driver }));
    const since = holder === 'nobody' ? {} : { drivesForS: this.drivesForS };
    this.#robot.tell({ type: 'operators', operators, ...since });
  }

  /** Another asks the page's operator for the drive, or offers it. */
  wants(kind: Handover['kind'], name: string): void {
    const [you, other] = [this.#you, this.here.find((each) => each.name === name)];
    if (you !== undefined && other !== undefined) this.#begin(kind, other, you);
  }

  /** The other answers the page's operator. */
  answers(accept: boolean): void {
    this.#end(accept ? 'accepted' : 'refused');
  }

  /** The page's operator asks or offers. */
  request(kind: Handover['kind'], to: number | undefined): void {
    const other = to === undefined ? this.#driver : this.here.find(({ number }) => number === to);
    const you = this.#you;
    if (you === undefined || other === undefined) return;
    if (this.#open === null) this.#begin(kind, you, other);
    else this.#robot.tell({ type: 'fault', message: 'one request at a time' });
  }

  /** The page's operator answers another, or takes its own back. */
  close(id: number, end: 'accepted' | 'refused' | 'withdrawn'): void {
    if (this.#open?.id === id && this.#open.yours === (end === 'withdrawn')) this.#end(end);
  }

  /** Whatever is asked or offered ends, because something else has happened. */
  interrupt(end: HandoverEnd): void {
    this.#end(end);
  }

  get #you() {
    return this.here.find(({ you }) => you);
  }

  get #driver() {
    const { holder, driver } = this.#robot.lease;
    if (holder === 'you') return this.#you;
    return holder === 'nobody' ? undefined : this.here.find(({ name, you }) => !you && name === driver);
  }

  #begin(
    kind: Handover['kind'],
    from: ScriptedPeople['here'][number],
    to: ScriptedPeople['here'][number],
  ): void {
    const named = ({ number, name, claimed }: typeof from) =>
      claimed === undefined ? { number, name } : { number, name, claimed };
    const [id, yours] = [++this.#id, from.you];
    this.#open = { type: 'handover', id, kind, from: named(from), to: named(to), yours };
    this.#robot.tell({ ...this.#open, leftMs: HANDOVER_MS });
    clearTimeout(this.#ends);
    this.#ends = setTimeout(() => this.#end('expired'), HANDOVER_MS);
  }

  /** As a robot does it: who drives is told before the end. */
  #end(ended: HandoverEnd): void {
    const open = this.#open;
    if (open === null) return;
    this.#open = null;
    clearTimeout(this.#ends);
    if (ended === 'accepted') {
      const isYours = (open.kind === 'ask') === open.yours;
      const other = open.yours ? open.to : open.from;
      this.drivesForS = 0;
      if (isYours) this.#robot.giveLease('you');
      else this.#robot.giveLease('other', other.name);
    }
    this.#robot.tell({ ...open, ended });
  }
}
