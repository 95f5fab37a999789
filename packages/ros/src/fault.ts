import * as z from 'zod';

export type RosFaultCode =
  | 'unavailable' // something needed to reach the graph is missing: a library, a master, an interface
  | 'lost' // it was available, and is gone
  | 'refused' // a peer or the master refused
  | 'wrong-type' // the topic carries messages of another type
  | 'bad-message' // bytes that are not a message of the type
  | 'bad-cloud' // a PointCloud2 whose fields and sizes are inconsistent
  | 'bad-image' // an image or a camera description that is inconsistent
  | 'too-large' // more than there is room for
  | 'unsupported'; // an unsupported encoding or type

/** What is wrong with a ROS graph or a message, where, and how to fix it. */
export class RosFault extends Error {
  override readonly name = 'RosFault';
  readonly code: RosFaultCode;
  /** What is wrong, without the location. */
  readonly what: string;
  readonly topic: string | undefined;
  /** Byte of the message at which it was found. */
  readonly offset: number | undefined;
  /** How to fix it, for people. */
  readonly remedy: string | undefined;

  constructor(
    code: RosFaultCode,
    what: string,
    about: { topic?: string; offset?: number; remedy?: string; cause?: unknown } = {},
  ) {
    const { topic, offset, remedy, cause } = about;
    const place = [topic, offset === undefined ? undefined : `byte ${offset}`].filter(
      (part) => part !== undefined,
    );
    super([...place, remedy === undefined ? what : `${what}; ${remedy}`].join(': '), { cause });
    this.code = code;
    this.what = what;
    this.topic = topic;
    this.offset = offset;
    this.remedy = remedy;
  }

  /** The same fault with its topic; anything else thrown while reading a message becomes a `bad-message`. */
  static of(error: unknown, topic: string): RosFault {
    if (error instanceof RosFault) {
      const { code, what, offset, remedy } = error;
      if (error.topic !== undefined) return error;
      return new RosFault(code, what, {
        topic,
        cause: error,
        ...(offset === undefined ? {} : { offset }),
        ...(remedy === undefined ? {} : { remedy }),
      });
    }
    return new RosFault('bad-message', messageFault(error), { topic, cause: error });
  }
}

/** What is wrong with a message, in one sentence: where a schema refuses it, the place of the first value that is wrong. */
export function messageFault(error: unknown): string {
  if (!(error instanceof z.ZodError)) return error instanceof Error ? error.message : String(error);
  const [first] = error.issues;
  if (first === undefined) return 'the message is not of its type';
  const path = first.path
    .map((step) => (typeof step === 'number' ? `[${step}]` : `.${String(step)}`))
    .join('');
  const more = error.issues.length > 1 ? `, and ${error.issues.length - 1} more` : '';
  return `${path === '' ? 'the message' : path.replace(/^\./, '')}: ${first.message}${more}`;
}
