/** Everything that the robot tells about itself besides its state: readings, samples, components' reports, alarms. */
import type { Alarm, Quantity } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import type { TimedBaseState } from '../base/base.ts';
import { AlarmBoard, type AlarmRule } from './alarms/alarm-board.ts';
import { ComponentBoard } from './component-board.ts';
import { ReadingBoard } from './reading-board.ts';
import { SampleBoard } from './sample-board.ts';

/** What alarms can watch of the robot's own state, by the name in the configuration. */
export const STATE_QUANTITIES = {
  speed: { label: 'Speed', unit: 'm/s' },
  charge: { label: 'Battery', unit: '%' },
  voltage: { label: 'Battery voltage', unit: 'V' },
} as const;

/** By which alarms watch a topic's quantity. */
export function watchName(topic: string, field: string): string {
  return `${topic} ${field}`;
}

export class TelemetryBoard {
  readonly readings = new ReadingBoard();
  readonly components = new ComponentBoard();
  readonly samples: SampleBoard;
  readonly alarms: AlarmBoard;
  readonly quantities: readonly Quantity[];
  readonly #watched = new Map<string, readonly string[]>();

  constructor(quantities: readonly Quantity[], rules: readonly AlarmRule[]) {
    this.quantities = quantities;
    this.samples = new SampleBoard(quantities);
    this.alarms = new AlarmBoard(rules);
    for (const { topic, field } of quantities)
      this.#watched.set(topic, [...(this.#watched.get(topic) ?? []), watchName(topic, field)]);
  }

  /** Takes what a topic says. */
  take(reading: TopicReading, nowMs: number): void {
    this.readings.add(reading, nowMs);
    if (reading.numbers !== undefined) this.sample(reading.topic, reading.numbers, nowMs);
    if (reading.components !== undefined) this.components.take(reading.topic, reading.components, nowMs);
  }

  /** Takes the numbers of a topic: its quantities, in their order. */
  sample(topic: string, numbers: readonly (number | null)[], nowMs: number): void {
    this.samples.add(topic, numbers, nowMs);
    (this.#watched.get(topic) ?? []).forEach((name, i) => {
      const value = numbers[i];
      if (value !== undefined && value !== null) this.alarms.take(name, value, nowMs);
    });
  }

  /** Takes the base's state. */
  state({ timeMs, twist, battery }: TimedBaseState): void {
    const { x, y } = twist.linear;
    this.alarms.take('speed', Math.hypot(x, y), timeMs);
    if (battery === null) return;
    this.alarms.take('charge', battery.percentage * 100, timeMs);
    this.alarms.take('voltage', battery.voltage, timeMs);
  }

  /** The alarms that have changed since the last call. */
  alarmChanges(): Alarm[] {
    return this.alarms.changes();
  }
}
