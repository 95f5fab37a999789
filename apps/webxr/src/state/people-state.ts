/** What the people at the robot ask of each other. */
import type { OpenHandover, RobotClient } from '@farpoint/operator';
import type { ReadonlySignal } from '@preact/signals-core';
import { pointingBar } from './pointers.ts';
import { type Sampler, steady } from './sampler.ts';

/** A request or an offer that can be answered or taken back. */
export interface ShownHandover extends Omit<OpenHandover, 'endsAtMs'> {
  /** Whole seconds. */
  readonly leftS: number;
}

export class PeopleState {
  /** What this operator is to answer: the oldest; `null` if nothing. */
  readonly asked: ReadonlySignal<ShownHandover | null>;
  /** What this operator has asked for or offered, and what is not answered yet; `null` if nothing. */
  readonly own: ReadonlySignal<ShownHandover | null>;
  /** For how long the one who drives has driven, whole minutes; `null` if nobody knows. */
  readonly drivesMinutes: ReadonlySignal<number | null>;

  /** Whether others see where this operator points. */
  readonly mayPoint: ReadonlySignal<boolean>;

  constructor({ link }: Pick<RobotClient, 'link'>, samples: Sampler) {
    const open = (yours: boolean) =>
      steady(
        samples.of((atMs): ShownHandover | null => {
          if (link.phase !== 'live') return null;
          const found = link.session.people.open(atMs).find((each) => each.yours === yours);
          if (found === undefined) return null;
          const { endsAtMs, ...shown } = found;
          return { ...shown, leftS: Math.ceil((endsAtMs - atMs) / 1000) };
        }),
      );
    this.asked = open(false);
    this.own = open(true);
    this.mayPoint = samples.of(() => link.phase === 'live' && pointingBar(link.session) === null);
    this.drivesMinutes = samples.of((atMs) => {
      if (link.phase !== 'live') return null;
      const sinceMs = link.session.people.drivesSinceMs;
      return sinceMs === null ? null : Math.floor((atMs - sinceMs) / 60_000);
    });
  }
}
