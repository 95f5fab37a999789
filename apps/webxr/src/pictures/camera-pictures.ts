/** The newest picture of each camera, and its age. */
import type { Picture } from '@farpoint/operator';
import { computed, type ReadonlySignal, type Signal, signal } from '@preact/signals-core';
import type { Switch, Switches } from '../state/switches.ts';

/** Pictures older than this are marked as stale, ms. */
const STALE_MS = 1000;

export interface ShownPicture {
  /** On the page's clock, ms: when the picture was taken, and when it was drawn. */
  readonly takenAtMs: number;
  readonly drawnAtMs: number;
  /** Counts from 1 in each session. */
  readonly number: number;
}

export interface CameraView {
  readonly camera: Switch;
  /** Holds the newest picture at its own size. */
  readonly canvas: HTMLCanvasElement;
  /** `null` before the first picture. */
  readonly newest: ReadonlySignal<ShownPicture | null>;
  /** Age of the newest picture, ms; `null` before the first. */
  readonly ageMs: ReadonlySignal<number | null>;
  readonly stale: ReadonlySignal<boolean>;
  /** Number of files that could not be decoded. */
  readonly failures: number;
}

interface OwnView extends CameraView {
  readonly newest: Signal<ShownPicture | null>;
  failures: number;
}

export class CameraPictures {
  readonly #views: ReadonlySignal<readonly OwnView[]>;
  /** One view per camera, in the robot's order. */
  readonly views: ReadonlySignal<readonly CameraView[]>;

  /** @param atMs the time for which ages are computed: page's clock, ms */
  constructor(cameras: Switches, atMs: ReadonlySignal<number>, newCanvas: () => HTMLCanvasElement) {
    this.#views = computed(() => cameras.all.value.map((camera) => viewOf(camera, atMs, newCanvas())));
    this.views = this.#views;
  }

  /** Draws the picture and closes its bitmap. @param nowMs page's clock */
  show({ camera, bitmap, takenAtMs }: Picture, nowMs: number): void {
    const view = this.#views.peek()[camera];
    if (view !== undefined) {
      const { canvas, newest } = view;
      if (canvas.width !== bitmap.width || canvas.height !== bitmap.height) {
        canvas.width = bitmap.width;
        canvas.height = bitmap.height;
      }
      canvas.getContext('2d')?.drawImage(bitmap, 0, 0);
      const number = (newest.peek()?.number ?? 0) + 1;
      newest.value = { takenAtMs, drawnAtMs: nowMs, number };
    }
    bitmap.close();
  }

  /** Counts a file of this camera that could not be decoded. */
  onFault(camera: number, detail: string): void {
    const view = this.#views.peek()[camera];
    if (view === undefined) return;
    view.failures++;
    if (view.failures === 1) console.warn(`a picture of ${view.camera.name} cannot be shown:`, detail);
  }
}

function viewOf(camera: Switch, atMs: ReadonlySignal<number>, canvas: HTMLCanvasElement): OwnView {
  const newest = signal<ShownPicture | null>(null);
  const ageMs = computed(() => {
    if (newest.value === null) return null;
    const { takenAtMs, drawnAtMs } = newest.value;
    return Math.max(0, Math.max(atMs.value, drawnAtMs) - takenAtMs);
  });
  const stale = computed(() => ageMs.value !== null && ageMs.value > STALE_MS);
  return { camera, canvas, newest, ageMs, stale, failures: 0 };
}
