import type { TopicReading } from '@farpoint/ros';
import type { EarthFrame } from '@farpoint/safety';

/** Where the satellite receiver says that the robot is, in a frame on the earth. */
export class FixPosition {
  readonly #earth: EarthFrame;
  readonly #topic: string;
  #place: { x: number; y: number; atMs: number } | null = null;

  /** @param topic of the receiver */
  constructor(earth: EarthFrame, topic: string) {
    this.#earth = earth;
    this.#topic = topic;
  }

  /** The newest; `null` before the first, and after the receiver has said that it knows no position. */
  get place(): Readonly<{ x: number; y: number; atMs: number }> | null {
    return this.#place;
  }

  /** Takes any reading of the robot. @param atMs when it came, robot's clock */
  take({ topic, numbers }: Pick<TopicReading, 'topic' | 'numbers'>, atMs: number): void {
    if (topic !== this.#topic) return;
    const [latitude, longitude] = numbers ?? [];
    if (typeof latitude !== 'number' || typeof longitude !== 'number') {
      this.#place = null;
      return;
    }
    const [x, y] = this.#earth.toFrame(latitude, longitude);
    this.#place = { x, y, atMs };
  }
}
