/** Everything that the robot tells about itself besides its state: readings, samples, components' reports, alarms, path, map, model. */

import {
  NO_PLAYED_TELEMETRY,
  type PlayedMessage,
  type PlayedTelemetry,
  type TimedBaseState,
} from '@farpoint/cloud-source';
import type { Alarm, Quantity } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import { AlarmBoard, type AlarmRule } from './alarms/alarm-board.ts';
import { ComponentBoard } from './component-board.ts';
import { ModelBoard } from './model-board.ts';
import { NavigationBoard } from './navigation-board.ts';
import { ReadingBoard } from './reading-board.ts';
import { SampleBoard, type TelemetryTaker } from './sample-board.ts';

/** What alarms can watch of the robot's own state, by the name in the configuration. */
export const STATE_QUANTITIES = {
  speed: { label: 'Speed', unit: 'm/s' },
  charge: { label: 'Battery', unit: '%' },
  voltage: { label: 'Battery voltage', unit: 'V' },
} as const;

/**
 * Raised alarms are recorded again at this interval, so that a player can begin anywhere, ms. Chosen: a
 * player looks back no farther.
 */
const REPEAT_MS = 5000;
/** An alarm is recorded at the time at which it was judged, unless that was longer ago: it is a played one, ms. */
const MOST_LATE_MS = 1000;

/** By which alarms watch a topic's quantity. */
export function watchName(topic: string, field: string): string {
  return `${topic} ${field}`;
}

export class TelemetryBoard {
  readonly readings = new ReadingBoard();
  readonly components = new ComponentBoard();
  readonly navigation = new NavigationBoard();
  readonly model = new ModelBoard();
  readonly samples: SampleBoard;
  readonly alarms: AlarmBoard;
  /** The robot's own, then those of the recording that it plays. */
  readonly quantities: readonly Quantity[];
  /** Records what the board takes; `null` if nothing is recorded. */
  taker: TelemetryTaker | null = null;
  readonly #watched = new Map<string, readonly string[]>();
  readonly #own: { readonly quantities: number; readonly alarms: number };
  #repeatedMs = 0;

  /** @param played what the recording has that the robot plays */
  constructor(
    quantities: readonly Quantity[],
    rules: readonly AlarmRule[],
    played: PlayedTelemetry = NO_PLAYED_TELEMETRY,
  ) {
    this.#own = { quantities: quantities.length, alarms: rules.length };
    const others = played.quantities.map(
      (quantity, i): Quantity => ({
        type: 'quantity',
        number: quantities.length + i,
        ...quantity,
        recorded: true,
      }),
    );
    this.quantities = [...quantities, ...others];
    this.samples = new SampleBoard(quantities);
    this.alarms = new AlarmBoard(rules, played.alarms.length);
    for (const { topic, field } of quantities)
      this.#watched.set(topic, [...(this.#watched.get(topic) ?? []), watchName(topic, field)]);
  }

  /** Takes what a topic says. */
  take(reading: TopicReading, nowMs: number): void {
    if (reading.model !== undefined || reading.joints !== undefined) {
      this.model.take(reading, nowMs);
      return;
    }
    this.readings.add(reading, nowMs);
    if (reading.numbers !== undefined) this.sample(reading.topic, reading.numbers, nowMs);
    const { topic, components, navigation } = reading;
    if (navigation !== undefined) this.navigation.take(topic, navigation, nowMs);
    if (components === undefined) return;
    this.components.take(topic, components, nowMs);
    this.taker?.diagnostics(topic, nowMs, components);
  }

  /** Takes the numbers of a topic: its quantities, in their order. */
  sample(topic: string, numbers: readonly (number | null)[], nowMs: number): void {
    this.samples.add(topic, numbers, nowMs, this.taker);
    (this.#watched.get(topic) ?? []).forEach((name, i) => {
      const value = numbers[i];
      if (value !== undefined && value !== null) this.alarms.take(name, value, nowMs);
    });
  }

  /** Takes the base's state. */
  state({ timeMs, twist, battery }: TimedBaseState): void {
    if (twist !== null) this.alarms.take('speed', Math.hypot(twist.linear.x, twist.linear.y), timeMs);
    const { percentage, voltage } = battery ?? {};
    if (percentage !== undefined) this.alarms.take('charge', percentage * 100, timeMs);
    if (voltage !== undefined) this.alarms.take('voltage', voltage, timeMs);
  }

  /** Takes what the played recording tells at its time. It is shown, but not judged again. */
  play(message: PlayedMessage): void {
    switch (message.kind) {
      case 'sample': {
        const number = this.#own.quantities + message.quantity;
        if (number >= this.quantities.length) return;
        this.samples.addOne(number, message.value, message.timeMs);
        this.taker?.sample(number, message.timeMs, message.value);
        return;
      }
      case 'alarm':
        this.alarms.play(this.#own.alarms + message.alarm, message.state);
        return;
      case 'diagnostics':
        this.components.take(message.topic, message.reports, message.timeMs, true);
        this.taker?.diagnostics(message.topic, message.timeMs, message.reports);
        return;
      case 'restart':
        this.alarms.clearPlayed(message.timeMs);
    }
  }

  /** The alarms that have changed since the last call. */
  alarmChanges(nowMs: number): Alarm[] {
    const changes = this.alarms.changes();
    const { taker } = this;
    if (taker === null) return changes;
    for (const alarm of changes)
      taker.alarm(alarm.number, Math.max(alarm.sinceMs, nowMs - MOST_LATE_MS), alarm);
    if (nowMs - this.#repeatedMs >= REPEAT_MS) {
      this.#repeatedMs = nowMs;
      for (const alarm of this.alarms.raised)
        if (!changes.includes(alarm)) taker.alarm(alarm.number, nowMs, alarm);
    }
    return changes;
  }
}
