/** What a recording holds for people besides its clouds: pictures and readings from the topics that the table names. */
import { type RecordedMessage, type RecordedTopic, RecordingError } from '@farpoint/recording';
import type { TopicEntry, TopicReading, TopicTable } from '@farpoint/ros';
import { ReadingTopic } from '../../ground/ros/reading-topic.ts';
import { PICTURE_TYPES, readPicture } from '../pictures/picture-message.ts';
import type { PictureTaker } from '../pictures/source-picture.ts';
import { type CameraDescription, cameraOf } from './frame-source.ts';

export class RecordingTopics {
  readonly cameras: readonly CameraDescription[];
  taker: PictureTaker | null = null;
  onReading: ((reading: TopicReading) => void) | null = null;
  readonly #pictures: readonly TopicEntry[];
  readonly #readings = new Map<string, ReadingTopic>();
  readonly #now: () => number;
  #perSecond: readonly number[] = [];

  /** @param now robot’s clock, ms */
  constructor(table: TopicTable, now: () => number) {
    this.#now = now;
    this.#pictures = table.filter(({ as }) => as === 'picture');
    this.cameras = this.#pictures.map(cameraOf);
    for (const entry of table)
      if (ReadingTopic.is(entry)) this.#readings.set(entry.topic, new ReadingTopic(entry));
  }

  get names(): string[] {
    return [...this.#pictures.map(({ topic }) => topic), ...this.#readings.keys()];
  }

  /** Topics that the table names and the recording lacks. The others are played. */
  missing(file: string, recorded: readonly RecordedTopic[]): RecordingError[] {
    const pictures = recorded.filter(({ type }) => PICTURE_TYPES.includes(type)).map(({ name }) => name);
    const others = `with pictures: ${pictures.join(', ') || 'none'}`;
    const faults: RecordingError[] = [];
    for (const topic of this.names) {
      const found = recorded.filter(({ name }) => name === topic);
      const fault = (detail: string) => faults.push(new RecordingError('no-topic', detail, { file, topic }));
      const isPicture = this.#camera(topic) >= 0;
      if (found.length === 0) fault(isPicture ? `no such topic; ${others}` : 'no such topic');
      else if (isPicture && !found.some(({ type }) => PICTURE_TYPES.includes(type)))
        fault(`its type is ${found[0]?.type || 'unknown'}, not pictures; ${others}`);
    }
    return faults;
  }

  /** @param perSecond pictures per second for each camera; 0: nobody watches */
  watch(perSecond: readonly number[]): void {
    this.#perSecond = perSecond;
  }

  wants(topic: string): boolean {
    return this.#readings.has(topic) || (this.#perSecond[this.#camera(topic)] ?? 0) > 0;
  }

  /** @param dueMs when it was due, on the robot's clock @throws {Error} if it cannot be read */
  take({ topic, data, offset }: RecordedMessage, dueMs: number): void {
    const now = this.#now();
    const reading = this.#readings.get(topic.name);
    if (reading !== undefined) {
      const told = reading.admits(now) ? reading.take(topic.decode(data), now) : null;
      if (told !== null) this.onReading?.(told);
      return;
    }
    const { taker } = this;
    const camera = this.#camera(topic.name);
    if (taker === null || !taker.wants(camera, now)) return;
    const { facts, data: picture } = readPicture(topic.type, topic.decode(data));
    const origin = `${topic.name}: byte ${offset}`;
    taker.offer({ camera, capturedAtMs: dueMs, facts, data: picture, origin });
  }

  #camera(topic: string): number {
    return this.#pictures.findIndex((entry) => entry.topic === topic);
  }
}
