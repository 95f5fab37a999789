/** How the link is divided among clouds and videos where they want more than it carries. */
import { computed, type ReadonlySignal, type Signal, signal } from '@preact/signals-core';

/** What comes first; the other still gets its part. */
export const PRIORITIES = ['balanced', 'clouds', 'cameras'] as const;
export type Priority = (typeof PRIORITIES)[number];

/** Relative weights, as the robot takes them. */
export interface Shares {
  readonly cloud: number;
  readonly videos: readonly number[];
}

/** Of all clouds and of each video. Those of `balanced` are what the robot does unasked. */
const WEIGHTS: Readonly<Record<Priority, { cloud: number; video: number }>> = {
  balanced: { cloud: 2, video: 1 },
  clouds: { cloud: 6, video: 1 },
  cameras: { cloud: 1, video: 2 },
};
/**
 * An enlarged video shows three times as much as it would otherwise. Chosen: who enlarges it wants to see
 * more, and the others still move.
 */
const ENLARGED = 3;

export class LinkPriority {
  readonly chosen: Signal<Priority> = signal('balanced');
  readonly shares: ReadonlySignal<Shares>;

  /**
   * @param videos how many there are
   * @param enlarged the number of the one that is enlarged; `null` if none is
   */
  constructor(videos: ReadonlySignal<number>, enlarged: ReadonlySignal<number | null>) {
    this.shares = computed(() => {
      const { cloud, video } = WEIGHTS[this.chosen.value];
      const weightOf = (number: number) => (number === enlarged.value ? video * ENLARGED : video);
      return { cloud, videos: Array.from({ length: videos.value }, (_, number) => weightOf(number)) };
    });
  }
}
