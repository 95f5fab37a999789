import { type LinkProfile, VirtualLink } from '@farpoint/network-sim';
import type { TimedEvents } from './timed-events.ts';

/** One direction of the link between an operator and the robot, which can be changed while packets are under way. */
export class Direction {
  readonly #events: TimedEvents;
  readonly #link: VirtualLink;
  readonly #usual: LinkProfile;

  constructor(events: TimedEvents, profile: LinkProfile, seed: number) {
    this.#events = events;
    this.#usual = profile;
    this.#link = new VirtualLink(events, { profile, seed });
  }

  /** @param arrive called when the packet arrives; never if it is lost */
  send(bytes: number, arrive: () => void): void {
    this.#events.advance();
    this.#link.send(bytes, {
      delivered: (atMs) => this.#events.at(atMs, arrive),
      dropped: () => undefined,
    });
  }

  /** From now on the link is so, and as it was first in everything else. */
  set(change: Partial<LinkProfile>): void {
    this.#events.advance();
    this.#link.model.setProfile({ ...this.#usual, ...change }, this.#events.nowMs);
    this.#events.advance();
  }

  /** Whether every packet is dropped on entering. */
  blackhole(active: boolean): void {
    this.#link.model.blackhole(active, this.#now);
  }

  /** Whether packets wait. */
  pause(paused: boolean): void {
    this.#link.model.pause(paused, this.#now);
    // What has waited has a time again.
    this.#events.at(this.#events.nowMs, () => this.#link.model.advance(this.#events.nowMs));
  }

  get #now(): number {
    this.#events.advance();
    return this.#events.nowMs;
  }
}
