/** A camera as the page shows it: the newest picture on a canvas, and its age. */
import { computed, type ReadonlySignal, type Signal, signal } from '@preact/signals-core';
import type { Switch } from '../switches.ts';

/**
 * Pictures older than this are marked as stale, ms. Chosen: docs/ros.md says it; two pictures a second are
 * the fewest that are planned.
 */
export const STALE_MS = 1000;

export interface ShownPicture {
  /** On the page's clock, ms: when the picture was taken, and when it was drawn. */
  readonly takenAtMs: number;
  readonly drawnAtMs: number;
  /** Counts from 1 in each session. */
  readonly number: number;
}

/** What panels and sheets show of a camera, whether it sends single pictures or a video. */
export interface CameraView {
  readonly kind: 'picture' | 'video';
  readonly camera: Switch;
  /** Holds the newest picture at its own size. */
  readonly canvas: HTMLCanvasElement;
  /** `null` before the first picture. */
  readonly newest: ReadonlySignal<ShownPicture | null>;
  /** Age of the newest picture, ms; `null` before the first. */
  readonly ageMs: ReadonlySignal<number | null>;
  readonly stale: ReadonlySignal<boolean>;
  /** Why there are no pictures at present, for people; `null` while there are. */
  readonly fault: ReadonlySignal<string | null>;
  /** Switches the camera on or off. */
  toggle(): void;
}

export interface CameraViewParts {
  readonly kind: CameraView['kind'];
  readonly camera: Switch;
  readonly canvas: HTMLCanvasElement;
  readonly fault: ReadonlySignal<string | null>;
  /** The time for which ages are computed: page's clock, ms. */
  readonly atMs: ReadonlySignal<number>;
  toggle(): void;
}

/** A view that pictures can be drawn to. */
export class DrawnCamera implements CameraView {
  readonly kind: CameraView['kind'];
  readonly camera: Switch;
  readonly canvas: HTMLCanvasElement;
  readonly newest: Signal<ShownPicture | null> = signal(null);
  readonly ageMs: ReadonlySignal<number | null>;
  readonly stale: ReadonlySignal<boolean>;
  readonly fault: ReadonlySignal<string | null>;
  readonly toggle: () => void;
  /** Number of pictures that could not be decoded. */
  failures = 0;

  constructor({ kind, camera, canvas, fault, atMs, toggle }: CameraViewParts) {
    this.kind = kind;
    this.camera = camera;
    this.canvas = canvas;
    this.fault = fault;
    this.toggle = toggle;
    this.ageMs = computed(() => {
      if (this.newest.value === null) return null;
      const { takenAtMs, drawnAtMs } = this.newest.value;
      return Math.max(0, Math.max(atMs.value, drawnAtMs) - takenAtMs);
    });
    this.stale = computed(() => this.ageMs.value !== null && this.ageMs.value > STALE_MS);
  }

  /** @param takenAtMs on the page's clock, as is `nowMs` */
  draw(image: CanvasImageSource, width: number, height: number, takenAtMs: number, nowMs: number): void {
    const { canvas, newest } = this;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    canvas.getContext('2d')?.drawImage(image, 0, 0, width, height);
    const number = (newest.peek()?.number ?? 0) + 1;
    newest.value = { takenAtMs, drawnAtMs: nowMs, number };
  }
}
