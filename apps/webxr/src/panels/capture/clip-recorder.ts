/** Encodes what is seen, all the time, and keeps the last while of it. Loaded when clips are wanted. */
import { type ClipPicture, ClipRing } from '../../ground/capture/clip-ring.ts';
import { type PictureSize, pictureSize } from '../../ground/capture/picture-size.ts';
import { paintView, viewSize } from './view-painter.ts';

/** Every browser with an encoder has this codec, and it costs least. */
export const CLIP_CODEC = 'vp8';
/** Chosen: what led to an incident fits in; the settings and docs/events.md name both. */
const LIMITS = { seconds: 30, mostBytes: 32 * 1024 * 1024 };
/** Chosen: clouds come at most so often over most links, and encoding must not slow down what is shown. */
export const CLIP_FRAMES_PER_SECOND = 15;
const MOST_SIDE = 1280;
/** Of the encoded pictures, bit/s: 30 s are 11 MB. Chosen: points and captions stay sharp at 1280 × 720. */
const BITS_PER_SECOND = 3_000_000;
/** Between key pictures, µs. Chosen: a clip begins with one, so it is at most so much longer than 30 s. */
const KEY_US = 2_000_000;
/** Pictures that may wait for the encoder; further ones are left out. */
const MOST_WAITING = 2;

export interface ClipSource {
  /** Calls `act` once, in the next display frame, after the scene is drawn and before it is shown. */
  afterNextFrame(act: () => void): void;
  /** Written into each picture. */
  caption(): readonly string[];
}

/** What was seen, encoded. */
export interface Clip {
  readonly size: PictureSize;
  readonly pictures: readonly ClipPicture[];
}

export class ClipRecorder {
  /** Called when nothing more can be encoded. */
  onFailure: ((detail: string) => void) | null = null;
  readonly #source: ClipSource;
  readonly #ring = new ClipRing(LIMITS);
  readonly #sheet: OffscreenCanvas;
  readonly #context: OffscreenCanvasRenderingContext2D | null;
  readonly #encoder: VideoEncoder;
  readonly #timer: number;
  #keyUs = Number.NEGATIVE_INFINITY;
  /** A picture is taken with the next display frame. */
  #isDue = false;
  #ended = false;

  /** All pictures have the size that the view has now; a view that changes its shape later is fitted into it. */
  constructor(source: ClipSource) {
    this.#source = source;
    const { width, height } = pictureSize(viewSize(), MOST_SIDE);
    this.#sheet = new OffscreenCanvas(width, height);
    this.#context = this.#sheet.getContext('2d', { alpha: false });
    this.#encoder = new VideoEncoder({
      output: (chunk) => this.#keep(chunk),
      error: ({ message }) => this.onFailure?.(message),
    });
    this.#encoder.configure({
      codec: CLIP_CODEC,
      width,
      height,
      latencyMode: 'realtime',
      bitrate: BITS_PER_SECOND,
      framerate: CLIP_FRAMES_PER_SECOND,
    });
    this.#timer = window.setInterval(() => this.#request(), 1000 / CLIP_FRAMES_PER_SECOND);
  }

  /** What was seen up to now; no picture if nothing was. */
  async clip(): Promise<Clip> {
    if (this.#encoder.state === 'configured') await this.#encoder.flush();
    const { width, height } = this.#sheet;
    return { size: { width, height }, pictures: this.#ring.pictures };
  }

  close(): void {
    this.#ended = true;
    window.clearInterval(this.#timer);
    this.#ring.clear();
    if (this.#encoder.state !== 'closed') this.#encoder.close();
  }

  #request(): void {
    // While the page is hidden, no frame is drawn.
    if (this.#isDue) return;
    this.#isDue = true;
    this.#source.afterNextFrame(() => {
      this.#isDue = false;
      if (!this.#ended) this.#take();
    });
  }

  #take(): void {
    const context = this.#context;
    const encoder = this.#encoder;
    if (context === null || encoder.state !== 'configured' || encoder.encodeQueueSize >= MOST_WAITING) return;
    paintView(context, this.#sheet, this.#source.caption());
    const timestamp = Math.round(performance.now() * 1000);
    const picture = new VideoFrame(this.#sheet, { timestamp });
    const keyFrame = timestamp - this.#keyUs >= KEY_US;
    if (keyFrame) this.#keyUs = timestamp;
    encoder.encode(picture, { keyFrame });
    picture.close();
  }

  #keep(chunk: EncodedVideoChunk): void {
    const bytes = new Uint8Array(chunk.byteLength);
    chunk.copyTo(bytes);
    this.#ring.add({ key: chunk.type === 'key', timestampUs: chunk.timestamp, bytes });
  }
}
