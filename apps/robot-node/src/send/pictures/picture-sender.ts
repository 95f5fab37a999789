import { BitRate } from '@farpoint/timing';
import type { ReadyPicture } from '../../sense/pictures/picture-messages.ts';
import { LEAST_PICTURES_PER_SECOND } from '../../sense/pictures/picture-plan.ts';

/** Why this operator did not get a picture, or not all of it. */
export type PictureDropReason =
  | 'superseded' // a newer one of its camera came before its turn
  | 'backlog' // what was sent before has not left yet
  | 'overdue'; // it took too long

/** The operator's channel for pictures. */
export interface PictureLink {
  /** Bytes queued for sending. */
  readonly picturesBuffered: number;
  /** @returns bytes on the wire, all headers counted; 0 if it was not sent */
  sendPicture(chunk: Uint8Array): number;
}

/**
 * No chunk is sent while more than this is queued, bytes. Messages share the association and would have to
 * wait for it. Two chunks of 1,160 bytes fit. Chosen: one is not enough to keep the channel busy between two
 * calls.
 */
const MOST_BUFFERED = 2400;
/**
 * The longest time for which unused credit is saved, ms. Chosen: at 3 Mbit/s, 37 kB, a picture; more would
 * delay clouds in one piece. picture-sender.test.ts holds it.
 */
const BURST_MS = 100;
/**
 * The rest of a picture that has taken this long to send is dropped, ms. Chosen: three of the longest
 * intervals that are planned (picture-plan.ts); picture-sender.test.ts holds it.
 */
const OVERDUE_MS = (3 * 1000) / LEAST_PICTURES_PER_SECOND;

interface Sending {
  picture: ReadyPicture;
  next: number;
  beganMs: number;
}

/**
 * One operator's pictures. The newest picture of each camera waits for its turn. Pictures are sent one after another,
 * chunk by chunk, at the rate that is left for pictures. The sender owns no timer: call `sendDue` often, and whenever
 * the channel has room again.
 */
export class PictureSender {
  /** Cameras that the operator wants to see. */
  watched: ReadonlySet<number> = new Set();
  picturesSent = 0;
  bytesSent = 0;
  readonly drops: Record<PictureDropReason, number> = { superseded: 0, backlog: 0, overdue: 0 };
  readonly #link: PictureLink;
  readonly #onSent: () => void;
  /** By camera, in the order in which they will be sent. */
  readonly #waiting = new Map<number, ReadyPicture>();
  #sending: Sending | null = null;
  #creditBytes = 0;
  #filledMs: number | null = null;

  /** @param onSent a whole picture is on its way */
  constructor(link: PictureLink, onSent: () => void = () => undefined) {
    this.#link = link;
    this.#onSent = onSent;
  }

  watch(cameras: readonly number[]): void {
    this.watched = new Set(cameras);
    for (const camera of this.#waiting.keys()) if (!this.watched.has(camera)) this.#waiting.delete(camera);
  }

  offer(picture: ReadyPicture): void {
    const { camera } = picture.header;
    if (!this.watched.has(camera)) return;
    // The camera keeps its place in the queue, so that a fast camera does not push back a slow one.
    if (this.#waiting.has(camera)) this.drops.superseded++;
    this.#waiting.set(camera, picture);
  }

  /** Sends what is due. @param bitsPerSecond the present rate for pictures; 0 holds everything back */
  sendDue(nowMs: number, bitsPerSecond: number): void {
    this.#fill(nowMs, bitsPerSecond);
    while (this.#creditBytes > 0) {
      const sending = this.#sending ?? this.#begin(nowMs);
      if (sending === null) return;
      if (nowMs - sending.beganMs > OVERDUE_MS) {
        this.#end('overdue');
        continue;
      }
      if (this.#link.picturesBuffered > MOST_BUFFERED) return;
      const chunk = sending.picture.chunks[sending.next] as Uint8Array;
      const bytes = this.#link.sendPicture(chunk);
      if (bytes === 0) {
        this.#end('backlog');
        return;
      }
      this.#creditBytes -= bytes;
      this.bytesSent += bytes;
      sending.next++;
      if (sending.next < sending.picture.chunks.length) continue;
      this.picturesSent++;
      this.#onSent();
      this.#sending = null;
    }
  }

  /** Drops everything, because nobody is watching. */
  clear(): void {
    this.#waiting.clear();
    this.#sending = null;
  }

  #begin(nowMs: number): Sending | null {
    for (const [camera, picture] of this.#waiting) {
      this.#waiting.delete(camera);
      if (this.#link.picturesBuffered > MOST_BUFFERED) {
        this.drops.backlog++;
        continue;
      }
      this.#sending = { picture, next: 0, beganMs: nowMs };
      return this.#sending;
    }
    return null;
  }

  #end(reason: PictureDropReason): void {
    this.drops[reason]++;
    this.#sending = null;
  }

  #fill(nowMs: number, bitsPerSecond: number): void {
    const bytesPerMs = BitRate.bytesIn(bitsPerSecond, 1);
    const elapsed = this.#filledMs === null ? 0 : Math.max(0, nowMs - this.#filledMs);
    this.#filledMs = nowMs;
    // A chunk is sent only while there is credit; the last one may overdraw it slightly.
    this.#creditBytes = Math.min(this.#creditBytes + elapsed * bytesPerMs, bytesPerMs * BURST_MS);
  }
}
