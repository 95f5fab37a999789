/** Passes on to the other operators at which spot one of them points. */
import type { Point, RobotSessionMessage } from '@farpoint/protocol';
import { TokenBucket } from '@farpoint/timing';
import { mayDrive } from '../../admit/access/access.ts';
import { isHere, type ListedOperator, type OperatorRoster } from '../../admit/access/operator-roster.ts';
import type { RobotCounters } from '../../ground/robot-counters.ts';

/**
 * Of all operators together: each spot goes to everybody else, reliably, and some links carry little. Chosen: two who point as
 * often as each may. pointing.test.ts holds it.
 */
const ALL = { perSecond: 20, burst: 20 };

export interface PointingOptions {
  operators: ReadonlyMap<string, ListedOperator>;
  roster: Pick<OperatorRoster, 'numberOf'>;
  /** Whether operators whose grant lets them only watch may point. */
  watchersPoint: boolean;
  counters: Pick<RobotCounters, 'messagesRefused'>;
  now: () => number;
}

export class Pointing {
  readonly #options: PointingOptions;
  readonly #rate = new TokenBucket(ALL);

  constructor(options: PointingOptions) {
    this.#options = options;
  }

  /** What an operator is told after its welcome. */
  told({ messages }: Pick<ListedOperator, 'messages'>): RobotSessionMessage {
    return { type: 'pointing', may: this.#options.watchersPoint || mayDrive(messages.access) };
  }

  /** The operator points. It has not done so too often: its own rate was looked at before. */
  point(by: ListedOperator, { at }: Point): void {
    const { operators, roster, watchersPoint, counters, now } = this.#options;
    if (!isHere(by)) return;
    if (!watchersPoint && !mayDrive(by.messages.access)) {
      const message = 'your grant lets you watch, but not point';
      by.messages.send({ type: 'fault', message, reason: 'not-permitted' });
      return;
    }
    if (!this.#rate.take(now())) {
      counters.messagesRefused.add('point:rate-limited');
      return;
    }
    const pointed = { type: 'pointed', by: roster.numberOf(by), at } as const;
    for (const operator of operators.values())
      if (operator !== by && isHere(operator)) operator.messages.send(pointed);
  }
}
