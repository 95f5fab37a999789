import type { PlayClock } from '../play-timeline.ts';

/** A clock that jumps to whatever time is waited for. */
export class FakeClock implements PlayClock {
  ms = 0;
  readonly waits: number[] = [];

  now(): number {
    return this.ms;
  }

  async wait(ms: number): Promise<void> {
    this.waits.push(ms);
    this.ms += ms;
  }
}
