/** Codes what the scene shows, all the time, and keeps the last while of it. Loaded when clips are wanted. */
import { type ClipPicture, ClipRing } from './clip-ring.ts';
import { type ClipSize, clipSize } from './clip-size.ts';

/** What a clip is coded with: every browser that has coders has this one, and it costs least. */
export const CLIP_CODEC = 'vp8';
export const CLIP_SECONDS = 30;
const LIMITS = { seconds: CLIP_SECONDS, mostBytes: 32 * 1024 * 1024 };
const FRAMES_PER_SECOND = 15;
const BITS_PER_SECOND = 3_000_000;
/** Between key pictures, microseconds: a clip begins with one. */
const KEY_US = 2_000_000;
/** Pictures that may wait for the coder; more are left out. */
const MOST_WAITING = 2;

export interface ClipSource {
  readonly canvas: HTMLCanvasElement;
  /** Calls `act` once, in the next display frame, after the scene is drawn and before it is shown. */
  afterNextFrame(act: () => void): void;
  /** Written into each picture: when, where, and whether it was live. */
  caption(): string;
}

/** What was shown, coded. */
export interface Clip {
  readonly size: ClipSize;
  readonly pictures: readonly ClipPicture[];
}

export class ClipRecorder {
  /** Called when nothing more can be coded. */
  onFailure: ((detail: string) => void) | null = null;
  readonly #source: ClipSource;
  readonly #ring = new ClipRing(LIMITS);
  readonly #sheet = new OffscreenCanvas(2, 2);
  readonly #context = this.#sheet.getContext('2d', { alpha: false });
  readonly #timer: number;
  #coder: VideoEncoder | null = null;
  #size: ClipSize = { width: 0, height: 0 };
  #keyUs = Number.NEGATIVE_INFINITY;
  /** A picture is taken with the next display frame. */
  #isDue = false;
  #ended = false;

  constructor(source: ClipSource) {
    this.#source = source;
    this.#timer = window.setInterval(() => this.#tick(), 1000 / FRAMES_PER_SECOND);
  }

  /** What was shown up to now; no picture if nothing was. */
  async clip(): Promise<Clip> {
    if (this.#coder?.state === 'configured') await this.#coder.flush();
    return { size: this.#size, pictures: this.#ring.pictures };
  }

  close(): void {
    this.#ended = true;
    window.clearInterval(this.#timer);
    this.#ring.clear();
    this.#closeCoder();
  }

  #tick(): void {
    // While the page is hidden nothing is drawn.
    if (this.#isDue) return;
    this.#isDue = true;
    this.#source.afterNextFrame(() => {
      this.#isDue = false;
      if (!this.#ended) this.#take();
    });
  }

  #take(): void {
    const context = this.#context;
    if (context === null) return;
    const size = clipSize(this.#source.canvas);
    if (size.width !== this.#size.width || size.height !== this.#size.height) this.#begin(size);
    const coder = this.#coder;
    if (coder?.state !== 'configured' || coder.encodeQueueSize >= MOST_WAITING) return;
    context.drawImage(this.#source.canvas, 0, 0, size.width, size.height);
    write(context, this.#source.caption(), size);
    const timestampUs = Math.round(performance.now() * 1000);
    const picture = new VideoFrame(this.#sheet, { timestamp: timestampUs });
    const keyFrame = timestampUs - this.#keyUs >= KEY_US;
    if (keyFrame) this.#keyUs = timestampUs;
    coder.encode(picture, { keyFrame });
    picture.close();
  }

  /** One file has pictures of one size: what was shown in another is given up. */
  #begin(size: ClipSize): void {
    this.#closeCoder();
    this.#ring.clear();
    this.#size = size;
    this.#keyUs = Number.NEGATIVE_INFINITY;
    Object.assign(this.#sheet, size);
    const coder = new VideoEncoder({
      output: (chunk) => {
        if (coder !== this.#coder) return;
        const bytes = new Uint8Array(chunk.byteLength);
        chunk.copyTo(bytes);
        this.#ring.add({ key: chunk.type === 'key', timestampUs: chunk.timestamp, bytes });
      },
      error: ({ message }) => this.onFailure?.(message),
    });
    coder.configure({
      ...{ codec: CLIP_CODEC, ...size, latencyMode: 'realtime' },
      ...{ bitrate: BITS_PER_SECOND, framerate: FRAMES_PER_SECOND },
    });
    this.#coder = coder;
  }

  #closeCoder(): void {
    const coder = this.#coder;
    this.#coder = null;
    if (coder !== null && coder.state !== 'closed') coder.close();
  }
}

/** At the lower left, as large as a fortieth of the picture. */
function write(context: OffscreenCanvasRenderingContext2D, text: string, { height }: ClipSize): void {
  const px = Math.max(10, Math.round(height / 40));
  context.font = `${px}px sans-serif`;
  const { width } = context.measureText(text);
  context.fillStyle = 'rgb(0 0 0 / 60%)';
  context.fillRect(0, height - 2 * px, width + 2 * px, 2 * px);
  context.fillStyle = 'white';
  context.fillText(text, px, height - 0.7 * px);
}
