/** Who else is at the robot: what they ask of each other, and what they say. */
import type { HeardLine, OpenHandover, RobotClient } from '@farpoint/operator';
import { computed, type ReadonlySignal, signal } from '@preact/signals-core';
import type { Sampler } from '../state/sampler.ts';
import { steady } from '../state/steady.ts';

/** A request or an offer that can be answered or taken back. */
export interface ShownHandover extends Omit<OpenHandover, 'endsAtMs'> {
  /** Whole seconds. */
  readonly leftS: number;
}

const NONE: readonly HeardLine[] = [];

export class PeopleState {
  /** What this operator is to answer: the oldest; `null` if nothing. */
  readonly asked: ReadonlySignal<ShownHandover | null>;
  /** What this operator has asked for or offered, and what is not answered yet; `null` if nothing. */
  readonly own: ReadonlySignal<ShownHandover | null>;
  /** Since when the one who drives has driven, page's clock; `null` if nobody knows. */
  readonly drivesSinceMs: ReadonlySignal<number | null>;
  /** The last lines of chat. */
  readonly lines: ReadonlySignal<readonly HeardLine[]>;
  /** How many lines of others have come since the chat was last open. */
  readonly unread: ReadonlySignal<number>;
  /** Whether the chat is open. */
  readonly chatOpen = signal(false);
  readonly #readTo = signal(0);
  readonly #link: RobotClient['link'];

  constructor({ link }: Pick<RobotClient, 'link'>, samples: Sampler) {
    this.#link = link;
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
    this.drivesSinceMs = samples.of(() => link.session.people.drivesSinceMs);
    this.lines = samples.of(() => (link.phase === 'live' ? link.session.people.lines : NONE));
    this.unread = computed(() => {
      if (this.chatOpen.value) return 0;
      const readTo = this.#readTo.value;
      return this.lines.value.filter(({ yours, number }) => !yours && number > readTo).length;
    });
  }

  /** A line came. @param agoS how long ago it was said: those from before this session are not new */
  onLine(number: number, agoS: number): void {
    if (agoS > 0 || this.chatOpen.peek()) this.#readTo.value = number;
  }

  /** The chat was opened or folded away. */
  set isChatOpen(open: boolean) {
    this.chatOpen.value = open;
    this.#readTo.value = this.#link.session.people.lines.at(-1)?.number ?? this.#readTo.peek();
  }

  /** A session begins: the robot may count anew. */
  reset(): void {
    this.#readTo.value = 0;
  }
}
