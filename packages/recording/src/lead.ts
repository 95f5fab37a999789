import type { RecordedMessage } from './recording.ts';

/** Limit on the messages of one run, bytes: more than any video has between two key frames. */
const MOST_RUN_BYTES = 16 * 1024 * 1024;

/** What came before the first cloud and is shown with it: each topic's newest message, and runs from their beginning. */
export class Lead {
  readonly #runs: ReadonlySet<string>;
  readonly #newest = new Map<string, RecordedMessage>();
  readonly #run = new Map<string, { messages: RecordedMessage[]; bytes: number }>();

  /** @param runs topics whose messages build on each other */
  constructor(runs: ReadonlySet<string>) {
    this.#runs = runs;
  }

  /** @param begins whether a run begins anew with it */
  add(message: RecordedMessage, begins: (message: RecordedMessage) => boolean): void {
    const { name } = message.topic;
    if (!this.#runs.has(name)) {
      this.#newest.set(name, message);
      return;
    }
    let run = this.#run.get(name);
    if (begins(message)) {
      run = { messages: [], bytes: 0 };
      this.#run.set(name, run);
    }
    // Without its beginning, the rest is of no use.
    if (run === undefined) return;
    run.messages.push(message);
    run.bytes += message.data.length;
    if (run.bytes > MOST_RUN_BYTES) this.#run.delete(name);
  }

  /**
   * Takes everything, in each topic's order.
   *
   * @param sinceNs single messages that are older are left out; runs are not
   */
  take(sinceNs: bigint): RecordedMessage[] {
    const single = [...this.#newest.values()].filter(({ logNs }) => logNs >= sinceNs);
    const runs = [...this.#run.values()].flatMap(({ messages }) => messages);
    this.#newest.clear();
    this.#run.clear();
    return [...single, ...runs];
  }
}
