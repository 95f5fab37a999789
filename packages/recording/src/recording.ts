/** A recording as seen by a player, independent of its file format. */
import type { RecordingError } from './errors.ts';

export interface RecordedTopic {
  name: string;
  /** Type of its messages in ROS 2 notation, for example `sensor_msgs/msg/PointCloud2`; ROS 1 names are converted. */
  type: string;
  /** What its recorder noted about it. */
  metadata?: ReadonlyMap<string, string>;
  /** Number of messages; `null` if the file does not state it. */
  messages: number | null;
  /**
   * Decodes a message's bytes according to its schema.
   *
   * @throws {Error} if they do not match, or the schema is unsupported
   */
  decode: (data: Uint8Array) => unknown;
}

export interface RecordedMessage {
  topic: RecordedTopic;
  /** When it was recorded, ns since 1970. */
  logNs: bigint;
  /** May be a view of a larger buffer: copy what is kept for long. */
  data: Uint8Array;
  /** Byte of the file near which it lies. */
  offset: number;
}

export interface Recording {
  readonly file: string;
  readonly topics: readonly RecordedTopic[];
  /** Times of the first and the last message. */
  readonly startNs: bigint;
  readonly endNs: bigint;
  /** A problem that does not prevent playing, for example where the file was cut short. */
  readonly warning: string | null;
  /**
   * Messages in order of time, from `fromNs` on.
   *
   * @param onDamage called for an unreadable part if the file's index shows what comes after it, where reading
   * continues
   * @throws {RecordingError} at an unreadable part, if there is no `onDamage` or what comes after is unknown
   */
  messages(
    topics: readonly string[],
    fromNs: bigint,
    onDamage?: (fault: RecordingError) => void,
  ): AsyncGenerator<RecordedMessage, void, void>;
  close(): Promise<void>;
}
