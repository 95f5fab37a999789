import { type MapTiles, sequenceDelta32, tileCount, writeTile } from '@farpoint/protocol';

/** Where a map lies, and how large its cells are. */
export type MapPlace = Pick<MapTiles, 'width' | 'height' | 'cellM' | 'origin'>;

/** The robot's map of what is free and what is occupied, put together from tiles. */
export class NavigatorMap {
  /** Where it lies in the world; `null` before the first message. A new object for another map. */
  place: MapPlace | null = null;
  /**
   * Row by row from the origin, x first. 0: unknown, or not told yet; 1: free; 2: between free and occupied; 3: occupied.
   */
  cells: Uint8Array = new Uint8Array();
  /** The robot's topic that it comes from; `null` before the first message. */
  topic: string | null = null;
  /** Counts the changes of the cells. */
  changes = 0;
  #number = 0;
  /** When the robot received the map that each tile is of, robot's clock, ms. */
  #tileTimes = new Float64Array();
  #heardMs = 0;
  /** When the robot received the newest map: robot's clock, and this one. */
  #timeMs = -1;
  #receivedAtMs = 0;

  /**
   * Takes some tiles. The channel is unordered: what was overtaken is ignored.
   *
   * @param nowMs when they arrived, `performance.now()`
   * @returns whether anything of the map is new
   */
  take(message: MapTiles, nowMs: number): boolean {
    const { number, timeMs, ageMs, topic, tiles } = message;
    const delta = sequenceDelta32(number, this.#number);
    if (this.place !== null && delta < 0) return false;
    const isOther = this.place === null || delta > 0;
    if (isOther) this.#begin(message);
    this.#heardMs = nowMs;
    this.topic = topic;
    // Of the same map, the message that was the fastest says best how old it is.
    if (timeMs > this.#timeMs) [this.#timeMs, this.#receivedAtMs] = [timeMs, nowMs - ageMs];
    else if (timeMs === this.#timeMs) this.#receivedAtMs = Math.min(this.#receivedAtMs, nowMs - ageMs);
    let isNew = isOther;
    for (const [index, runs] of tiles) {
      if (index >= this.#tileTimes.length || timeMs <= (this.#tileTimes[index] as number)) continue;
      this.#tileTimes[index] = timeMs;
      writeTile(this.place as MapPlace, index, runs, this.cells);
      isNew = true;
    }
    if (isNew) this.changes++;
    return isNew;
  }

  /** How long ago the robot received the map, ms; `null` before the first message. @param nowMs `performance.now()` */
  ageMs(nowMs: number): number | null {
    return this.place === null ? null : Math.max(0, nowMs - this.#receivedAtMs);
  }

  /**
   * Time since the robot told any of it, ms; `null` before the first message. It repeats its map tile by tile, so a
   * silence means that it has none any more, or that the link is gone.
   *
   * @param nowMs `performance.now()`
   */
  silentMs(nowMs: number): number | null {
    return this.place === null ? null : Math.max(0, nowMs - this.#heardMs);
  }

  #begin({ number, width, height, cellM, origin }: MapTiles): void {
    this.#number = number;
    this.place = { width, height, cellM, origin };
    this.cells = new Uint8Array(width * height);
    this.#tileTimes = new Float64Array(tileCount(this.place)).fill(-1);
  }
}
