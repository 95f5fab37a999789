/** The robot's cameras as the page shows them: which are watched, the newest picture of each and how old it is. */
import type { Cameras, WholePicture } from '@farpoint/protocol';
import { DecodeQueue } from './decode-queue.ts';
import type { FromPictureWorker, PictureToDecode } from './worker-messages.ts';

/** An older picture is marked, ms. */
export const STALE_MS = 1000;

export interface CameraView {
  readonly camera: number;
  readonly name: string;
  /** Watched: its pictures are asked for. */
  shown: boolean;
  /** Holds the newest picture, in its own size. */
  readonly canvas: HTMLCanvasElement;
  /** When the newest picture was taken, page's clock, ms; `null` before the first. */
  takenMs: number | null;
  pictures: number;
  /** Files that could not be decoded. */
  failures: number;
}

export interface CameraViewsEvents {
  /** Other cameras, or others of them shown. */
  onChange(): void;
  /** Ask the robot for these. */
  onWatch(cameras: number[]): void;
  /** A new picture is on its canvas. */
  onPicture(view: CameraView): void;
}

export class CameraViews {
  views: readonly CameraView[] = [];
  readonly #events: CameraViewsEvents;
  readonly #ageMs: (stampUs: number, nowMs: number) => number | null;
  readonly #queue: DecodeQueue;
  readonly #receivedMs = new WeakMap<WholePicture, number>();
  /** Of whichever robot: what somebody has hidden stays hidden. */
  readonly #hidden = new Set<string>();
  #looking = true;
  #worker: Worker | null = null;

  /** @param ageMs how long ago a stamp of the robot's clock was; `null` until its clock is known */
  constructor(ageMs: (stampUs: number, nowMs: number) => number | null, events: CameraViewsEvents) {
    this.#ageMs = ageMs;
    this.#events = events;
    this.#queue = new DecodeQueue((picture) => this.#decode(picture));
  }

  /** The robot has told of its cameras. */
  setCameras(cameras: Cameras['cameras']): void {
    this.#queue.clear();
    this.views = cameras.map(({ name }, camera) => ({
      ...{ camera, name, shown: !this.#hidden.has(name), canvas: document.createElement('canvas') },
      ...{ takenMs: null, pictures: 0, failures: 0 },
    }));
    this.#events.onChange();
    if (cameras.length > 0) this.#watch();
  }

  /** Shows or hides a camera: a hidden one costs the link nothing. */
  toggle(view: CameraView): void {
    view.shown = !view.shown;
    if (view.shown) this.#hidden.delete(view.name);
    else this.#hidden.add(view.name);
    this.#events.onChange();
    this.#watch();
  }

  /** Whether anybody can see the page. */
  set looking(looking: boolean) {
    if (looking === this.#looking) return;
    this.#looking = looking;
    if (this.views.length > 0) this.#watch();
  }

  add(picture: WholePicture, nowMs: number): void {
    if (this.views[picture.camera]?.shown !== true) return;
    this.#receivedMs.set(picture, nowMs);
    this.#queue.add(picture);
  }

  /** Of the newest picture, ms; `null` before the first. */
  ageMs({ takenMs }: CameraView, nowMs: number): number | null {
    return takenMs === null ? null : Math.max(0, nowMs - takenMs);
  }

  #watch(): void {
    const watched = this.views.filter(({ shown }) => shown && this.#looking);
    this.#events.onWatch(watched.map(({ camera }) => camera));
  }

  #decode(picture: PictureToDecode): void {
    if (this.#worker === null) {
      const worker = new Worker(new URL('./picture-worker.ts', import.meta.url), { type: 'module' });
      worker.onmessage = ({ data }: MessageEvent<FromPictureWorker>) => this.#onDecoded(data);
      worker.onerror = (event) => {
        console.warn('picture worker:', event.message);
        // The next picture starts another one.
        worker.terminate();
        this.#worker = null;
        this.#queue.clear();
      };
      this.#worker = worker;
    }
    this.#worker.postMessage(picture);
  }

  #onDecoded(message: FromPictureWorker): void {
    const picture = this.#queue.ended(message.ticket);
    const view = picture === null ? undefined : this.views[picture.camera];
    if (picture === null || view === undefined) {
      if ('bitmap' in message) message.bitmap.close();
      return;
    }
    if ('fault' in message) {
      view.failures++;
      if (view.failures === 1) console.warn(`a picture of ${view.name} cannot be shown:`, message.fault);
      return;
    }
    const { bitmap } = message;
    const { canvas } = view;
    if (canvas.width !== bitmap.width || canvas.height !== bitmap.height) {
      canvas.width = bitmap.width;
      canvas.height = bitmap.height;
    }
    canvas.getContext('2d')?.drawImage(bitmap, 0, 0);
    bitmap.close();
    const receivedMs = this.#receivedMs.get(picture) ?? performance.now();
    view.takenMs = receivedMs - (this.#ageMs(picture.captureTimeUs, receivedMs) ?? 0);
    view.pictures++;
    this.#events.onPicture(view);
  }
}
