/** The link of `pnpm bench prediction`, and the messages that pass it. */
import { idealProfile, LinkModel } from '@farpoint/network-sim';

/** m and rad. */
export type Pose = { x: number; y: number; yaw: number };
/** m/s and rad/s. */
export type Wish = readonly [linear: number, angular: number];

/** A message from the page to the robot. */
export type Up = Command | { kind: 'probe'; sentMs: number };
export interface Command {
  kind: 'command';
  sequence: number;
  wish: Wish;
}

/** A message from the robot to the page. */
export type Down =
  | { kind: 'telemetry'; robotMs: number; pose: Pose }
  | { kind: 'cloud'; robotMs: number; pose: Pose }
  | { kind: 'answer'; id: number; sentMs: number; robotMs: number };

interface WayOptions {
  delayMs: number;
  /** ± per packet, ms. */
  jitterMs: number;
  /** Share of packets that are lost. */
  loss: number;
  seed: number;
}

/** One direction of the link. */
export class Way<Message> {
  readonly #link: LinkModel;
  readonly #messages = new Map<number, Message>();
  #handle = 0;

  constructor(
    { delayMs, jitterMs, loss, seed }: WayOptions,
    deliver: (message: Message, atMs: number) => void,
  ) {
    const profile = { ...idealProfile, delayMs, jitterMs, jitterReorders: true, loss };
    const sink = {
      delivered: (handle: number, atMs: number) => {
        const message = this.#messages.get(handle);
        this.#messages.delete(handle);
        if (message !== undefined) deliver(message, atMs);
      },
      duplicated: () => {},
    };
    this.#link = new LinkModel({ profile, seed, startMs: 0, sink });
  }

  send(message: Message, nowMs: number): void {
    this.#messages.set(++this.#handle, message);
    this.#link.offer(100, nowMs, this.#handle);
  }

  advance(nowMs: number): void {
    this.#link.advance(nowMs);
  }
}
