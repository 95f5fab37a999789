/** What became of an answer; `repeated` and `unasked` ones change nothing. */
export type AnswerVerdict = 'taken' | 'repeated' | 'unasked';

/** Which of the operator's answers counts: one for each offer, and none that was taken before. */
export class AnswerGate {
  #due = false;
  #last: string | null = null;

  /** An offer is made: it waits for its answer. */
  onOffer(): void {
    this.#due = true;
  }

  judge(sdp: string): AnswerVerdict {
    // Sent twice. Also where another offer waits by now: an answer to that one would have other credentials.
    if (sdp === this.#last) return 'repeated';
    if (!this.#due) return 'unasked';
    this.#due = false;
    this.#last = sdp;
    return 'taken';
  }
}
