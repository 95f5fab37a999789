/** The cameras that send videos: which of them are on, what is wrong with them, and what they show. */
import type { VideoDescription } from '@farpoint/operator';
import { computed, type ReadonlySignal, signal } from '@preact/signals-core';
import { DrawnCamera } from '../../ground/pictures/camera-view.ts';
import { Switches } from '../../ground/switches.ts';
import type { VideoImage } from './readers/video-image.ts';

export class VideoViews {
  /** Which of the videos are on: all at first. */
  readonly switches = new Switches();
  /** One view per video, in the robot's order. */
  readonly views: ReadonlySignal<readonly DrawnCamera[]>;
  /** By number: what the robot says is wrong, and what this browser cannot do. */
  readonly #faults = signal<readonly (string | undefined)[]>([]);
  readonly #obstacles = signal<ReadonlyMap<number, string>>(new Map());

  /** @param atMs the time for which ages are computed: page's clock, ms */
  constructor(atMs: ReadonlySignal<number>, newCanvas: () => HTMLCanvasElement) {
    const { switches } = this;
    this.views = computed(() =>
      switches.all.value.map((camera) => {
        const { index } = camera;
        const fault = computed(() => this.#obstacles.value.get(index) ?? this.#faults.value[index] ?? null);
        const toggle = () => switches.toggle(index);
        return new DrawnCamera({ kind: 'video', camera, canvas: newCanvas(), fault, atMs, toggle });
      }),
    );
  }

  /** Another session begins. */
  clear(): void {
    this.#obstacles.value = new Map();
    this.switches.set([]);
  }

  /** Takes the robot's list. One with the same cameras as before changes only what is wrong with them. */
  list(videos: readonly VideoDescription[]): void {
    this.#faults.value = videos.map(({ fault }) => fault);
    const names = this.switches.all.peek().map(({ name }) => name);
    const isSame = names.length === videos.length && videos.every(({ name }, video) => name === names[video]);
    if (!isSame) this.switches.set(videos);
  }

  /** This browser cannot show the video. @param words for people */
  cannotShow(video: number, words: string): void {
    this.#obstacles.value = new Map(this.#obstacles.peek()).set(video, words);
  }

  /** What this browser could not do may be otherwise from now on. */
  mayShow(video: number): void {
    const obstacles = new Map(this.#obstacles.peek());
    if (obstacles.delete(video)) this.#obstacles.value = obstacles;
  }

  /** Draws the picture and closes it. Times are on the page's clock. */
  show(video: number, image: VideoImage, takenAtMs: number, nowMs: number): void {
    this.views.peek()[video]?.draw(image.image, image.width, image.height, takenAtMs, nowMs);
    image.close();
  }
}
