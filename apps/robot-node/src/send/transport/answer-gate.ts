/** What became of an answer. `repeated` and `unasked` answers change nothing. */
export type AnswerVerdict = 'taken' | 'repeated' | 'unasked';

/** Decides which of the operator's answers counts: one per offer, and none that was already taken. */
export class AnswerGate {
  #due = false;
  #last: string | null = null;

  /** Registers an offer, which now waits for its answer. */
  onOffer(): void {
    this.#due = true;
  }

  judge(sdp: string): AnswerVerdict {
    // The same answer again. This holds even if another offer waits by now: its answer would have other credentials.
    if (sdp === this.#last) return 'repeated';
    if (!this.#due) return 'unasked';
    this.#due = false;
    this.#last = sdp;
    return 'taken';
  }
}
