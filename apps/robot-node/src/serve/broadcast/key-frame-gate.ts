/**
 * When a relay's requests for key frames are passed on: at once, but each video has at most one key frame in an interval,
 * whoever asks. A key frame that comes for another reason serves all who have asked. Time is an argument.
 */
export class KeyFrameGate {
  readonly #intervalMs: number;
  readonly #sentMs = new Map<number, number>();
  readonly #waiting = new Set<number>();
  /** Requests, including those that another one served. */
  requests = 0;

  constructor(intervalMs: number) {
    this.#intervalMs = intervalMs;
  }

  /** @returns whether to pass the request on now */
  request(video: number, nowMs: number): boolean {
    this.requests++;
    if (this.#isDue(video, nowMs)) {
      this.#waiting.delete(video);
      this.#sentMs.set(video, nowMs);
      return true;
    }
    this.#waiting.add(video);
    return false;
  }

  /** A key frame was sent. */
  onKeyFrame(video: number, nowMs: number): void {
    this.#waiting.delete(video);
    this.#sentMs.set(video, nowMs);
  }

  /** Call often. @returns the videos whose requests are to be passed on now */
  due(nowMs: number): number[] {
    const due = [...this.#waiting].filter((video) => this.#isDue(video, nowMs));
    for (const video of due) {
      this.#waiting.delete(video);
      this.#sentMs.set(video, nowMs);
    }
    return due;
  }

  #isDue(video: number, nowMs: number): boolean {
    return nowMs - (this.#sentMs.get(video) ?? Number.NEGATIVE_INFINITY) >= this.#intervalMs;
  }
}
