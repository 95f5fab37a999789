/** The robot's cameras as the page shows them: which are watched, the newest picture of each and how old it is. */
import type { Cameras, Picture } from '@farpoint/operator';

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
  takenAtMs: number | null;
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
  /** Of whichever robot: what somebody has hidden stays hidden. */
  readonly #hidden = new Set<string>();
  #looking = true;

  constructor(events: CameraViewsEvents) {
    this.#events = events;
  }

  /** The robot has told of its cameras. */
  setCameras(cameras: Cameras['cameras']): void {
    this.views = cameras.map(({ name }, camera) => ({
      ...{ camera, name, shown: !this.#hidden.has(name), canvas: document.createElement('canvas') },
      ...{ takenAtMs: null, pictures: 0, failures: 0 },
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

  /** Of the newest picture, ms; `null` before the first. */
  ageMs({ takenAtMs }: CameraView, nowMs: number): number | null {
    return takenAtMs === null ? null : Math.max(0, nowMs - takenAtMs);
  }

  /** A file of this camera could not be decoded. */
  onFault(camera: number, detail: string): void {
    const view = this.views[camera];
    if (view === undefined) return;
    view.failures++;
    if (view.failures === 1) console.warn(`a picture of ${view.name} cannot be shown:`, detail);
  }

  show({ camera, bitmap, takenAtMs }: Picture): void {
    const view = this.views[camera];
    if (view === undefined) {
      bitmap.close();
      return;
    }
    const { canvas } = view;
    if (canvas.width !== bitmap.width || canvas.height !== bitmap.height) {
      canvas.width = bitmap.width;
      canvas.height = bitmap.height;
    }
    canvas.getContext('2d')?.drawImage(bitmap, 0, 0);
    bitmap.close();
    view.takenAtMs = takenAtMs;
    view.pictures++;
    this.#events.onPicture(view);
  }

  #watch(): void {
    const watched = this.views.filter(({ shown }) => shown && this.#looking);
    this.#events.onWatch(watched.map(({ camera }) => camera));
  }
}
