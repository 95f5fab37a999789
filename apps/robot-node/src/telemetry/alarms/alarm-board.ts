/** The alarms of the robot's configuration: which are raised, and which have changed since they were last told. */
import { ALARM_TEXT_LENGTH, type Alarm, type ReadingLevel } from '@farpoint/protocol';
import { LimitJudge, type Limits } from './limits.ts';

/** An alarm as configured, with the quantity that it watches. */
export interface AlarmRule extends Limits {
  /** Names the quantity: what {@link AlarmBoard.take} is called with. */
  readonly watches: string;
  /** The quantity's name, for people. */
  readonly label: string;
  readonly unit: string;
  /** What is wrong and what to do; by default it says that the quantity is too low or too high. */
  readonly text?: string | undefined;
}

interface Entry {
  readonly number: number;
  readonly rule: AlarmRule;
  readonly judge: LimitJudge;
  /** As it was last told; `null` if it has never been raised. */
  told: Alarm | null;
  state: Alarm | null;
}

export class AlarmBoard {
  readonly #entries: readonly Entry[];
  readonly #byQuantity = new Map<string, Entry[]>();

  constructor(rules: readonly AlarmRule[]) {
    this.#entries = rules.map((rule, number) => {
      const entry: Entry = { number, rule, judge: new LimitJudge(rule), told: null, state: null };
      const others = this.#byQuantity.get(rule.watches) ?? [];
      this.#byQuantity.set(rule.watches, [...others, entry]);
      return entry;
    });
  }

  /** Takes a quantity's value. @param timeMs when it was measured, robot's clock */
  take(watches: string, value: number, timeMs: number): void {
    for (const entry of this.#byQuantity.get(watches) ?? []) {
      if (!entry.judge.take(value)) continue;
      const { level, side, limit } = entry.judge.verdict;
      if (limit === null) continue;
      const { rule, number } = entry;
      const text = (rule.text ?? `${rule.label} is too ${side}`).slice(0, ALARM_TEXT_LENGTH).toWellFormed();
      entry.state = { type: 'alarm', number, level, text, value, limit, unit: rule.unit, sinceMs: timeMs };
    }
  }

  /** Those that are raised. */
  get raised(): Alarm[] {
    return this.#entries.flatMap(({ state }) => (state === null || state.level === 'ok' ? [] : [state]));
  }

  /**
   * Those that differ from what the last call returned. An alarm that flutters is told as often as this is called, and
   * no more.
   */
  changes(): Alarm[] {
    const changed: Alarm[] = [];
    for (const entry of this.#entries) {
      const { state, told } = entry;
      if (state === null || state === told) continue;
      entry.told = state;
      // Raised and cleared between two calls: nobody has heard of it.
      if (state.level !== 'ok' || levelOf(told) !== 'ok') changed.push(state);
    }
    return changed;
  }
}

function levelOf(alarm: Alarm | null): ReadingLevel {
  return alarm?.level ?? 'ok';
}
