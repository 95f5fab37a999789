/** The videos of a recording that is played: which there are, and their coded pictures as they are due. */

import { type PlayedPicture, RECORDED_CODINGS, type RecordedCoding } from '@farpoint/cloud-source';
import { displayNameSchema, MAX_VIDEOS } from '@farpoint/protocol';
import type { RecordedMessage, RecordedTopic } from '@farpoint/recording';
import { FOXGLOVE_COMPRESSED_VIDEO_TYPES, foxgloveCompressedVideoSchema } from '@farpoint/ros';

const IDR_SLICE = 5;
const FIRST_SLICE = 1;

/** @param bytes H.264: an access unit as in Annex B; VP8: a frame (RFC 6386 §9.1) */
export function isKeyPicture(coding: 'h264' | 'vp8', bytes: Uint8Array): boolean {
  if (coding === 'vp8') return bytes.length > 0 && ((bytes[0] as number) & 1) === 0;
  for (let i = 0; i + 3 < bytes.length; i++) {
    if (bytes[i] !== 0 || bytes[i + 1] !== 0 || bytes[i + 2] !== 1) continue;
    const type = (bytes[i + 3] as number) & 0x1f;
    if (type === IDR_SLICE) return true;
    // All slices of an access unit are of a kind.
    if (type === FIRST_SLICE) return false;
    i += 2;
  }
  return false;
}

/** A video that a source plays. */
export interface PlayedVideo {
  /** For people. */
  name: string;
  topic: string;
}

/** Pictures from before a jump come again at once: their times still rise, by this at least, ms. */
const LEAST_STEP_MS = 0.01;
/** What is kept of a video from its last key frame on, for somebody who begins to watch. */
const MOST_KEPT = { pictures: 900, bytes: 16 * 1024 * 1024 };

interface Run {
  /** From a key frame on; `null` while there is none. */
  pictures: PlayedPicture[] | null;
  bytes: number;
  watched: boolean;
  /** Of the newest picture. */
  capturedAtMs: number;
}

export class RecordedVideos {
  readonly videos: readonly PlayedVideo[];
  /** Called with the pictures of watched videos. Their memory belongs to the receiver. */
  onPicture: ((video: number, picture: PlayedPicture) => void) | null = null;
  readonly #runs: Run[];

  /**
   * @param recorded topics of the recording
   * @param taken topics that are played in another way
   */
  constructor(recorded: readonly RecordedTopic[], taken: readonly string[]) {
    const names = new Set<string>();
    this.videos = recorded
      .filter(({ type, name }) => FOXGLOVE_COMPRESSED_VIDEO_TYPES.includes(type) && !taken.includes(name))
      .filter(({ messages }) => messages !== 0)
      .slice(0, MAX_VIDEOS)
      .map((topic) => ({ name: free(nameOf(topic), names), topic: topic.name }));
    this.#runs = this.videos.map(() => ({ pictures: null, bytes: 0, watched: false, capturedAtMs: 0 }));
  }

  get topics(): string[] {
    return this.videos.map(({ topic }) => topic);
  }

  /** Whether somebody watches one of them. */
  get watched(): boolean {
    return this.#runs.some(({ watched }) => watched);
  }

  /** Playing begins anew: each video goes on with a key frame. */
  restart(): void {
    for (const run of this.#runs) run.pictures = null;
  }

  /** Whether a message can be decoded without those before it. */
  begins({ topic, data }: RecordedMessage): boolean {
    const { format, data: bytes } = foxgloveCompressedVideoSchema.parse(topic.decode(data));
    return isKeyPicture(codingOf(format), bytes);
  }

  /** Somebody begins to watch a video, or nobody watches any more. It begins with its last key frame. */
  watch(video: number, watched: boolean): void {
    const run = this.#runs[video];
    if (run === undefined || run.watched === watched) return;
    run.watched = watched;
    if (watched) for (const picture of run.pictures ?? []) this.#give(video, picture);
  }

  /**
   * @param dueMs when it was due, on the robot's clock
   * @returns false if it belongs to none of the videos
   * @throws {Error} if it cannot be read
   */
  take({ topic, data }: RecordedMessage, dueMs: number): boolean {
    const video = this.videos.findIndex((each) => each.topic === topic.name);
    const run = this.#runs[video];
    if (run === undefined) return false;
    const { format, data: bytes } = foxgloveCompressedVideoSchema.parse(topic.decode(data));
    const coding = codingOf(format);
    if (isKeyPicture(coding, bytes)) {
      run.pictures = [];
      run.bytes = 0;
    }
    if (run.pictures === null) return true;
    run.capturedAtMs = Math.max(dueMs, run.capturedAtMs + LEAST_STEP_MS);
    const picture = { coding, bytes: new Uint8Array(bytes), capturedAtMs: run.capturedAtMs };
    run.bytes += bytes.length;
    run.pictures.push(picture);
    if (run.pictures.length > MOST_KEPT.pictures || run.bytes > MOST_KEPT.bytes) run.pictures = null;
    if (run.watched) this.#give(video, picture);
    return true;
  }

  /** A copy: the picture is kept for the next who watches. */
  #give(video: number, picture: PlayedPicture): void {
    this.onPicture?.(video, { ...picture, bytes: new Uint8Array(picture.bytes) });
  }
}

/** @throws {Error} for formats that this robot does not decode */
function codingOf(format: string): RecordedCoding {
  const coding = RECORDED_CODINGS.find((each) => each === format);
  if (coding === undefined)
    throw new Error(`video in ${format || 'no format'}, not ${RECORDED_CODINGS.join(' or ')}`);
  return coding;
}

function nameOf({ name, metadata }: RecordedTopic): string {
  const { data } = displayNameSchema.safeParse(metadata?.get('camera'));
  return data ?? name.slice(-64);
}

function free(name: string, taken: Set<string>): string {
  let found = name;
  for (let n = 2; taken.has(found); n++) found = `${name.slice(0, 60)} ${n}`;
  taken.add(found);
  return found;
}
