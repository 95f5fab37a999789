/** The quantities, alarms and components' reports of a recording that is played: which there are, and what is due. */

import type { PlayedMessage, PlayedTelemetry } from '@farpoint/cloud-source';
import {
  ALARM_TYPES,
  alarmRecordSchema,
  quantityOf,
  type RecordedMessage,
  type RecordedTopic,
  RecordingError,
  SAMPLE_TYPES,
  sampleRecordSchema,
  sincesOf,
} from '@farpoint/recording';
import { DIAGNOSTIC_TYPES, DiagnosticBoard, stampNs } from '@farpoint/ros';
import { msOfNs, nsOfMs } from '@farpoint/timing';
import * as z from 'zod';

/** As many as a page keeps. */
const MOST_COMPONENT_TOPICS = 8;

export class RecordedTelemetry {
  readonly description: PlayedTelemetry;
  /** Called with what is due. */
  onMessage: ((message: PlayedMessage) => void) | null = null;
  readonly #quantities: readonly string[];
  readonly #alarms: readonly string[];
  readonly #boards: Map<string, DiagnosticBoard>;

  /**
   * @param recorded topics of the recording
   * @param taken topics that are played in another way
   */
  constructor(recorded: readonly RecordedTopic[], taken: readonly string[]) {
    const free = recorded.filter(({ name, messages }) => messages !== 0 && !taken.includes(name));
    const [samples, alarms, components] = [SAMPLE_TYPES, ALARM_TYPES, DIAGNOSTIC_TYPES].map((types) =>
      free.filter(({ type }) => types.includes(type)),
    ) as [RecordedTopic[], RecordedTopic[], RecordedTopic[]];
    this.#quantities = samples.map(({ name }) => name);
    this.#alarms = alarms.map(({ name }) => name);
    this.#boards = new Map(
      components.slice(0, MOST_COMPONENT_TOPICS).map(({ name }) => [name, new DiagnosticBoard()]),
    );
    this.description = {
      quantities: samples.map(quantityOf),
      alarms: alarms.map(({ name, metadata }) => ({
        watches: metadata?.get('watches') ?? name,
        label: metadata?.get('label') ?? name,
      })),
    };
  }

  get topics(): string[] {
    return [...this.#quantities, ...this.#alarms, ...this.#boards.keys()];
  }

  /** Playing begins anew: what was known of the robot is from another instant. @param nowMs robot's clock */
  restart(nowMs: number): void {
    for (const topic of this.#boards.keys()) this.#boards.set(topic, new DiagnosticBoard());
    this.onMessage?.({ kind: 'restart', timeMs: nowMs });
  }

  /**
   * @param dueMs when it was due, on the robot's clock
   * @returns false if it belongs to another topic
   * @throws {RecordingError} `bad-message` if it does not match its type
   */
  take({ topic, logNs, data }: RecordedMessage, dueMs: number): boolean {
    const quantity = this.#quantities.indexOf(topic.name);
    const alarm = this.#alarms.indexOf(topic.name);
    const board = this.#boards.get(topic.name);
    if (quantity < 0 && alarm < 0 && board === undefined) return false;
    const message = topic.decode(data);
    /** @param ns since 1970 */
    const onClock = (ns: bigint) => Math.max(0, dueMs - Math.max(0, msOfNs(logNs - ns)));
    if (quantity >= 0) {
      const { value } = checked(sampleRecordSchema, message);
      this.onMessage?.({ kind: 'sample', quantity, value, timeMs: dueMs });
    } else if (alarm >= 0) {
      const { header, ...state } = checked(alarmRecordSchema, message);
      const sinceMs = onClock(stampNs(header.stamp));
      this.onMessage?.({ kind: 'alarm', alarm, state: { ...state, sinceMs } });
    } else if (board !== undefined) {
      tryRead(() => board.take(message, dueMs));
      const sinces = sincesOf(message);
      const reports = board.components.map((report) => {
        const ms = sinces.get(report.name);
        return ms === undefined || report.level === 'stale'
          ? report
          : { ...report, sinceMs: onClock(nsOfMs(ms)) };
      });
      this.onMessage?.({ kind: 'diagnostics', topic: topic.name, reports, timeMs: dueMs });
    }
    return true;
  }
}

function checked<Output>(schema: z.ZodType<Output>, message: unknown): Output {
  return tryRead(() => schema.parse(message));
}

/** @throws {RecordingError} with a sentence about what does not match */
function tryRead<Output>(read: () => Output): Output {
  try {
    return read();
  } catch (error) {
    if (!(error instanceof z.ZodError)) throw error;
    const detail = z.prettifyError(error).replaceAll(/\s*\n\s*/g, '; ');
    throw new RecordingError('bad-message', detail, { cause: error });
  }
}
