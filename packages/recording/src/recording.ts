/** What a recording is to whoever plays it, whatever its file format. */
import type { RecordingError } from './errors.ts';

export interface RecordedTopic {
  name: string;
  /** Type of its messages as ROS 2 writes it, e.g. `sensor_msgs/msg/PointCloud2`; ROS 1 names are turned into it. */
  type: string;
  /** How many messages; `null` where the file does not say. */
  messages: number | null;
  /** Turns a message's bytes into what its schema says. @throws {Error} where it does not fit, or nobody reads the schema */
  decode: (data: Uint8Array) => unknown;
}

export interface RecordedMessage {
  topic: RecordedTopic;
  /** When it was recorded, ns since 1970. */
  logNs: bigint;
  /** May be a part of a larger piece of memory: keep a copy of what is kept for long. */
  data: Uint8Array;
  /** Byte of the file near which it lies. */
  offset: number;
}

export interface Recording {
  readonly file: string;
  readonly topics: readonly RecordedTopic[];
  /** Of the first and the last message. */
  readonly startNs: bigint;
  readonly endNs: bigint;
  /** Something that is wrong and does not keep it from being played, e.g. where it was cut short. */
  readonly warning: string | null;
  /**
   * In the order of their time, from `fromNs` on.
   *
   * @param onDamage told of a part that cannot be read, where the file's index says what comes after it: it goes on there
   * @throws {RecordingError} at a place that cannot be read, and nobody wants to be told or knows what comes after it
   */
  messages(
    topics: readonly string[],
    fromNs: bigint,
    onDamage?: (fault: RecordingError) => void,
  ): AsyncGenerator<RecordedMessage, void, void>;
  close(): Promise<void>;
}
