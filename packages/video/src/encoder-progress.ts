/** Notices an encoder that takes pictures and gives none, although its process lives: a driver that hangs. */
import type { VideoStats } from './process-messages.ts';

/**
 * Statistics come each second: an encoder that gives nothing for so many, while so many pictures came, hangs.
 * Chosen: above the start of any encoder.
 */
const MOST_WITHOUT = 10;
/** Pictures that must have come meanwhile. */
const LEAST_PICTURES = 10;

export class EncoderProgress {
  #encoded = -1;
  /** Pictures that had come for the encoder when it last gave one. */
  #cameBefore = 0;
  #without = 0;

  /** Call with all statistics of a process. @returns what is wrong, for people; `null` if all is well */
  onStats({
    encoded,
    framesIn,
    skipped,
  }: Pick<VideoStats, 'encoded' | 'framesIn' | 'skipped'>): string | null {
    const came = framesIn - skipped;
    if (encoded !== this.#encoded) {
      this.#encoded = encoded;
      this.#cameBefore = came;
      this.#without = 0;
      return null;
    }
    // Without pictures to encode, it does nothing wrong.
    if (came - this.#cameBefore < LEAST_PICTURES) this.#without = 0;
    else this.#without++;
    if (this.#without < MOST_WITHOUT) return null;
    return `it has given no picture for ${MOST_WITHOUT} s, while ${came - this.#cameBefore} came`;
  }
}
