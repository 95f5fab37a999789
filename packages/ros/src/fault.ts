export type RosFaultCode =
  | 'unavailable' // what is needed to speak to the graph is not there: a library, a master, an interface
  | 'lost' // it was there, and is gone
  | 'refused' // a peer or the master said no
  | 'wrong-type' // the topic has messages of another type
  | 'bad-message' // bytes that are not a message of the type
  | 'bad-cloud' // a PointCloud2 whose fields and sizes do not agree
  | 'bad-image' // an image or its camera that is not what it says
  | 'too-large' // more than there is room for
  | 'unsupported'; // an encoding or a type that nobody here reads

/** What is wrong with a ROS graph or a message, where, and what helps. */
export class RosFault extends Error {
  override readonly name = 'RosFault';
  readonly code: RosFaultCode;
  /** What is wrong, without the place. */
  readonly what: string;
  readonly topic: string | undefined;
  /** Byte of the message at which it was found. */
  readonly offset: number | undefined;
  /** What helps, for people. */
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

  /** The same of a topic; anything else that was thrown while a message was read is a bad message. */
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
    const what = error instanceof Error ? error.message : String(error);
    return new RosFault('bad-message', what, { topic, cause: error });
  }
}
