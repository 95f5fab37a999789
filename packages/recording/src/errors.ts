import { messageFault, RosFault } from '@farpoint/ros';

export type RecordingErrorCode =
  | 'not-a-recording' // neither MCAP nor a ROS 1 bag of version 2.0
  | 'unreadable' // the system refuses access to the file
  | 'truncated' // the file ends too early
  | 'damaged' // bytes that the format does not allow, or a wrong checksum
  | 'too-large' // a record too large to keep in memory
  | 'not-indexed' // a bag whose writer was killed
  | 'unsupported' // an unsupported compression, encoding or schema
  | 'no-topic' // no such topic, or no topic with clouds
  | 'too-many' // more topics of a kind than can be shown
  | 'bad-message' // a message that does not match its schema
  | 'bad-cloud' // a PointCloud2 whose fields and sizes are inconsistent
  | 'bad-image'; // an image that does not match its description

/** What is wrong with a recording, and where. */
export class RecordingError extends Error {
  override readonly name = 'RecordingError';
  readonly code: RecordingErrorCode;
  /** What is wrong, without the location. */
  readonly detail: string;
  readonly topic: string | undefined;
  /** Byte of the file at or after which the error was found. */
  readonly offset: number | undefined;

  constructor(
    code: RecordingErrorCode,
    detail: string,
    where: { file?: string; topic?: string; offset?: number; cause?: unknown } = {},
  ) {
    const { file, topic, offset, cause } = where;
    // What is wrong from the first byte on is wrong with the file.
    const byte = offset === undefined || offset === 0 ? undefined : `byte ${offset}`;
    const place = [file, topic, byte].filter((part) => part !== undefined);
    super([...place, detail].join(': '), { cause });
    this.code = code;
    this.detail = detail;
    this.topic = topic;
    this.offset = offset;
  }
}

/** The message of anything thrown, in one sentence. */
export function detailOf(error: unknown): string {
  return messageFault(error);
}

const OF_MESSAGES: readonly string[] = [
  'bad-message',
  'bad-cloud',
  'bad-image',
  'too-large',
  'unsupported',
] satisfies RecordingErrorCode[];

/** The code for anything thrown while a message was read. */
export function codeOf(error: unknown): RecordingErrorCode {
  if (error instanceof RecordingError) return error.code;
  const code = error instanceof RosFault ? error.code : '';
  return OF_MESSAGES.includes(code) ? (code as RecordingErrorCode) : 'bad-message';
}
