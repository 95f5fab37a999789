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
  /** As it was last told; `null` if it has never been raised. */
  told: Alarm | null;
  state: Alarm | null;
}

/** One that is judged here. */
interface Judged extends Entry {
  readonly rule: AlarmRule;
  readonly judge: LimitJudge;
}

export class AlarmBoard {
  /** Those that are judged here, then those of a recording. */
  readonly #entries: readonly Entry[];
  readonly #byQuantity = new Map<string, Judged[]>();
  readonly #played: readonly Entry[];

  /** @param played number of alarms of the recording that is played */
  constructor(rules: readonly AlarmRule[], played = 0) {
    const judged = rules.map((rule, number) => {
      const entry: Judged = { number, rule, judge: new LimitJudge(rule), told: null, state: null };
      const others = this.#byQuantity.get(rule.watches) ?? [];
      this.#byQuantity.set(rule.watches, [...others, entry]);
      return entry;
    });
    this.#played = Array.from({ length: played }, (_, i) => ({
      number: rules.length + i,
      told: null,
      state: null,
    }));
    this.#entries = [...judged, ...this.#played];
  }

  /** Takes an alarm as it was recorded: it is told, not judged. A number without such an alarm is ignored. */
  play(number: number, recorded: Omit<Alarm, 'type' | 'number' | 'recorded'>): void {
    const entry = this.#played.find((each) => each.number === number);
    if (entry === undefined) return;
    const { level, value } = recorded;
    // The recorder repeats alarms that are raised.
    if (entry.state?.level === level && entry.state.value === value) return;
    entry.state = { type: 'alarm', number, ...recorded, recorded: true };
  }

  /** Nothing is known any more about the recorded alarms. @param timeMs robot's clock */
  clearPlayed(timeMs: number): void {
    for (const entry of this.#played)
      if (levelOf(entry.state) !== 'ok' && entry.state !== null)
        entry.state = { ...entry.state, level: 'ok', sinceMs: timeMs };
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
