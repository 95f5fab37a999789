/** The topics of what the robot tells about itself besides its state: quantities, alarms, reports of its components. */
import type { MessageOutputs } from './message-outputs.ts';
import type { RecordedAlarm, RecordedQuantity, TelemetryRecord } from './recorder-messages.ts';
import { ALARM_SCHEMA, DIAGNOSTIC_ARRAY_SCHEMA, SAMPLE_SCHEMA } from './ros-schemas.ts';
import { alarmMessage, diagnosticArray, sampleMessage } from './telemetry-messages.ts';
import { alarmTopics, quantityTopics } from './topic-names.ts';

type Outputs = Pick<MessageOutputs, 'add' | 'addChannel' | 'wants' | 'wantsLive'>;

export class TelemetryChannels {
  readonly #out: Outputs;
  readonly #nsOf: (ms: number) => bigint;
  #quantities: number[] = [];
  #alarms: number[] = [];
  readonly #components = new Map<string, number>();

  /** @param nsOf converts the robot's clock to the time since 1970 */
  constructor(out: Outputs, nsOf: (ms: number) => bigint) {
    this.#out = out;
    this.#nsOf = nsOf;
  }

  /** Creates a topic for each quantity and each alarm, even for those that will have no message. */
  describe(quantities: readonly RecordedQuantity[], alarms: readonly RecordedAlarm[]): void {
    const named = quantityTopics(quantities);
    this.#quantities = quantities.map(({ topic: source, field, label, unit }, i) =>
      this.#open(named[i] as string, 'farpoint_msgs/msg/Sample', SAMPLE_SCHEMA, {
        topic: source,
        field,
        label,
        unit,
      }),
    );
    const watched = alarmTopics(alarms.map(({ watches }) => watches));
    this.#alarms = alarms.map(({ watches, label }, i) =>
      this.#open(watched[i] as string, 'farpoint_msgs/msg/Alarm', ALARM_SCHEMA, { watches, label }),
    );
  }

  /** Viewers look for diagnostics under the robot's own name of the topic. */
  addComponents(topic: string): void {
    if (this.#components.has(topic)) return;
    const type = 'diagnostic_msgs/msg/DiagnosticArray';
    this.#components.set(topic, this.#open(topic, type, DIAGNOSTIC_ARRAY_SCHEMA));
  }

  /** The kinds that live viewers subscribe to. */
  get liveWishes(): TelemetryRecord['type'][] {
    const wanted = (channels: Iterable<number>) => [...channels].some((each) => this.#out.wantsLive(each));
    const wishes: TelemetryRecord['type'][] = [];
    if (wanted(this.#quantities)) wishes.push('sample');
    if (wanted(this.#alarms)) wishes.push('alarm');
    if (wanted(this.#components.values())) wishes.push('diagnostics');
    return wishes;
  }

  /** @returns false if there is no such quantity, alarm or topic @throws {Error} if writing fails */
  async add(record: TelemetryRecord, ns: bigint): Promise<boolean> {
    const channel =
      record.type === 'sample'
        ? this.#quantities[record.quantity]
        : record.type === 'alarm'
          ? this.#alarms[record.alarm]
          : this.#components.get(record.topic);
    if (channel === undefined) return false;
    if (this.#out.wants(channel))
      await this.#out.add(channel, record.sequence, ns, [this.#message(record, ns)]);
    return true;
  }

  #message(record: TelemetryRecord, ns: bigint): Uint8Array {
    switch (record.type) {
      case 'sample':
        return sampleMessage(ns, record.value);
      case 'alarm':
        return alarmMessage(this.#nsOf(record.state.sinceMs), record.state);
      case 'diagnostics':
        return diagnosticArray(ns, record.reports, this.#nsOf);
    }
  }

  #open(topic: string, name: string, text: string, metadata: Record<string, string> = {}): number {
    const schema = { name, encoding: 'ros2msg' as const, text };
    return this.#out.addChannel({ topic, messageEncoding: 'cdr', schema, metadata });
  }
}
