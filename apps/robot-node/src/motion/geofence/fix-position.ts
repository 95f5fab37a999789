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

  /**
   * Takes any reading of the robot. One of which nobody can tell when it was measured, or which is older than the newest, is
   * left out.
   *
   * @param receivedMs robot's clock
   */
  take(
    { topic, numbers, measuredMs }: Pick<TopicReading, 'topic' | 'numbers' | 'measuredMs'>,
    receivedMs: number,
  ): void {
    if (topic !== this.#topic || measuredMs === null) return;
    const atMs = measuredMs ?? receivedMs;
    if (this.#place !== null && atMs < this.#place.atMs) return;
    const [latitude, longitude] = numbers ?? [];
    if (typeof latitude !== 'number' || typeof longitude !== 'number') {
      this.#place = null;
      return;
    }
    const [x, y] = this.#earth.toFrame(latitude, longitude);
    this.#place = { x, y, atMs };
  }
}
