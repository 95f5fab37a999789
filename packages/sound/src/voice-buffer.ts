/** Puts the packets of a voice in order, and says when each is to be heard. Time is an argument; it owns no timer. */
import { SequenceNumber } from '@farpoint/rtp';
import { WindowedMinimum } from '@farpoint/timing';
import { opusDurationMs } from './opus-packet.ts';

/** Why a packet is not played. */
export type VoiceDrop =
  | 'malformed' // no Opus packet
  | 'late' // after its turn
  | 'duplicate' // received before
  | 'overflow'; // more sound than time: what a peer sends too fast

/** A packet whose turn has come. */
export interface PlayedVoice {
  /** When it is to be heard, on the clock of the calls, ms. Never before the end of what was played before. */
  readonly hearAtMs: number;
  readonly durationMs: number;
  /** An Opus packet; empty for one that was lost and is to be concealed. */
  readonly bytes: Uint8Array;
}

/**
 * From the arrival of a packet to its turn, ms. It begins in the middle, and follows the jitter. Chosen: a
 * packet at least; two at first, as a browser's own buffer (docs/sound.md); and what a talk bears.
 * voice-buffer.test.ts has paths of all kinds.
 */
export const LEAST_DELAY_MS = 20;
export const MOST_DELAY_MS = 100;
const FIRST_DELAY_MS = 40;
/** What the delay exceeds the jitter by, ms. Chosen: half of a packet. */
const MARGIN_MS = 10;
/** A packet must be decoded before it is heard, ms. */
const LEAD_MS = 5;
/**
 * More than this is not concealed, ms: the voice goes on after a pause. Chosen: Opus' concealment fades out
 * by then.
 */
const MOST_CONCEALED_MS = 100;
/**
 * After such a pause the voice begins anew, ms. Chosen: people pause between sentences for as long, and
 * nobody hears that the delay changes.
 */
const PAUSE_MS = 500;
/** A timestamp that deviates so much from its packet's arrival belongs to another time scale, ms. */
const OTHER_SCALE_MS = 500;
const MOST_WAITING = 8;
const TICKS_PER_MS = 48;
/** The fastest packet of so long tells what the path takes at least. */
const TRANSIT_WINDOW_MS = 10_000;
/** The jitter that was seen is forgotten by this factor per packet: by half in 10 s. */
const JITTER_DECAY = 0.9986;

interface Waiting {
  readonly sequence: number;
  readonly mediaMs: number;
  readonly durationMs: number;
  readonly bytes: Uint8Array;
}

export class VoiceBuffer {
  readonly drops: Partial<Record<VoiceDrop, number>> = {};
  /** Lost packets that were concealed. */
  concealed = 0;
  /** In order of sequence number. */
  readonly #waiting: Waiting[] = [];
  readonly #transit = new WindowedMinimum(TRANSIT_WINDOW_MS);
  #delayMs = FIRST_DELAY_MS;
  #jitterMs = 0;
  /** Of the sound that is played: sequence number and media time of what comes next; `null` before the first packet. */
  #next: { sequence: number; mediaMs: number } | null = null;
  /** Media time, which is the RTP timestamp unwrapped, and the last timestamp. */
  #mediaMs = 0;
  #timestamp = 0;
  /** What to add to a media time for the time of hearing. */
  #offsetMs = 0;
  /** The end of what was played. */
  #endMs = Number.NEGATIVE_INFINITY;
  #arrivedMs = Number.NEGATIVE_INFINITY;
  #durationMs = 20;

  /** From the fastest packet's arrival to its turn, ms. */
  get delayMs(): number {
    return this.#delayMs;
  }

  /**
   * @param sequence of RTP, 16 bits
   * @param timestamp of RTP, 32 bits, in 1/48000 s
   */
  push(sequence: number, timestamp: number, bytes: Uint8Array, nowMs: number): void {
    const durationMs = opusDurationMs(bytes);
    if (durationMs === null) {
      this.#drop('malformed');
      return;
    }
    const mediaMs = this.#unwrap(timestamp);
    if (this.#next === null || this.#beginsAnew(mediaMs, nowMs)) this.#begin(sequence, mediaMs, nowMs);
    const next = this.#next as { sequence: number; mediaMs: number };
    this.#arrivedMs = nowMs;
    this.#mediaMs = mediaMs;
    this.#timestamp = timestamp;
    this.#onTransit(nowMs - mediaMs, nowMs);
    const ahead = SequenceNumber.ahead(sequence, next.sequence);
    const isKnown = this.#waiting.some((each) => each.sequence === sequence);
    if (isKnown) {
      this.#drop('duplicate');
      return;
    }
    if (ahead < 0) {
      // Its turn is over; those behind it get more time.
      this.#postpone(mediaMs, nowMs);
      this.#drop('late');
      return;
    }
    if (ahead === 0) this.#postpone(mediaMs, nowMs);
    const at = this.#waiting.findIndex((each) => SequenceNumber.ahead(each.sequence, sequence) > 0);
    this.#waiting.splice(at < 0 ? this.#waiting.length : at, 0, { sequence, mediaMs, durationMs, bytes });
    if (this.#waiting.length > MOST_WAITING) {
      this.#waiting.shift();
      this.#drop('overflow');
    }
  }

  /** What is to be played next; `null` if nothing is due. Call it again until `null`. */
  take(nowMs: number): PlayedVoice | null {
    for (;;) {
      const [first] = this.#waiting;
      if (first === undefined || this.#next === null) return null;
      const gapMs = first.mediaMs - this.#next.mediaMs;
      const isNext = first.sequence === this.#next.sequence;
      // A gap in time without one in the numbers is a pause of the speaker's encoder.
      if (!isNext && gapMs > 0 && gapMs <= MOST_CONCEALED_MS) {
        if (this.#next.mediaMs + this.#offsetMs - LEAD_MS > nowMs) return null;
        const concealed = this.#conceal(Math.min(gapMs, this.#durationMs), nowMs);
        if (concealed !== null) return concealed;
        continue;
      }
      this.#waiting.shift();
      const { sequence, mediaMs, durationMs, bytes } = first;
      this.#next = { sequence: SequenceNumber.next(sequence), mediaMs: mediaMs + durationMs };
      this.#durationMs = durationMs;
      const played = this.#turn(mediaMs, durationMs, bytes, nowMs);
      if (played !== null) return played;
    }
  }

  /** When `take` has something without another packet's arrival; `null` if never. */
  get nextDueMs(): number | null {
    if (this.#waiting.length === 0 || this.#next === null) return null;
    return this.#next.mediaMs + this.#offsetMs - LEAD_MS;
  }

  /** Forgets the voice: the next packet begins another. */
  clear(): void {
    this.#waiting.length = 0;
    this.#next = null;
  }

  #unwrap(timestamp: number): number {
    return this.#next === null
      ? timestamp / TICKS_PER_MS
      : this.#mediaMs + ((timestamp - this.#timestamp) | 0) / TICKS_PER_MS;
  }

  #beginsAnew(mediaMs: number, nowMs: number): boolean {
    if (nowMs - this.#arrivedMs > PAUSE_MS) return true;
    return Math.abs(nowMs - mediaMs - this.#transit.value) > OTHER_SCALE_MS;
  }

  #begin(sequence: number, mediaMs: number, nowMs: number): void {
    this.#waiting.length = 0;
    this.#transit.reset();
    this.#delayMs = clamp(this.#jitterMs + MARGIN_MS, LEAST_DELAY_MS, MOST_DELAY_MS);
    if (this.#next === null && this.#jitterMs === 0) this.#delayMs = FIRST_DELAY_MS;
    this.#offsetMs = nowMs + this.#delayMs - mediaMs;
    this.#next = { sequence, mediaMs };
  }

  #onTransit(transitMs: number, nowMs: number): void {
    this.#transit.add(transitMs, nowMs);
    const jitterMs = transitMs - this.#transit.value;
    this.#jitterMs = Math.max(this.#jitterMs * JITTER_DECAY, jitterMs);
  }

  /** Gives what follows a late packet more time, up to the highest delay. */
  #postpone(mediaMs: number, nowMs: number): void {
    const lateMs = nowMs + LEAD_MS - (mediaMs + this.#offsetMs);
    if (lateMs <= 0) return;
    const by = Math.min(lateMs + MARGIN_MS, MOST_DELAY_MS - this.#delayMs);
    if (by <= 0) return;
    this.#delayMs += by;
    this.#offsetMs += by;
  }

  #conceal(durationMs: number, nowMs: number): PlayedVoice | null {
    const next = this.#next as { sequence: number; mediaMs: number };
    const { mediaMs } = next;
    next.mediaMs += durationMs;
    this.concealed++;
    return this.#turn(mediaMs, durationMs, NOTHING, nowMs);
  }

  #turn(mediaMs: number, durationMs: number, bytes: Uint8Array, nowMs: number): PlayedVoice | null {
    const dueMs = mediaMs + this.#offsetMs;
    const hearAtMs = Math.max(dueMs, this.#endMs);
    if (hearAtMs < nowMs) {
      this.#drop('late');
      return null;
    }
    if (hearAtMs > nowMs + MOST_DELAY_MS + durationMs) {
      this.#drop('overflow');
      return null;
    }
    this.#endMs = hearAtMs + durationMs;
    return { hearAtMs, durationMs, bytes };
  }

  #drop(reason: VoiceDrop): void {
    this.drops[reason] = (this.drops[reason] ?? 0) + 1;
  }
}

const NOTHING = new Uint8Array(0);

function clamp(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}
