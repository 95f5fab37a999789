/**
 * Estimates a camera's field of view from the points themselves, because the stream does not include it and the size of
 * a drawn point depends on it. Samples a few points of each packet; allocates nothing.
 */

/** A field of view of 90°, until a frame has given an estimate. */
export const DEFAULT_EXTENT = 2;

/** Samples of each packet that are looked at. Chosen: some hundred of a frame. */
const SAMPLES_PER_PACKET = 4;
/** A frame with fewer samples is ignored. */
const LEAST_SAMPLES = 16;
/** Tangents are clamped, since those of points beside the camera (LiDAR) are unbounded. */
const MOST_TANGENT = 3;
const SMOOTHING = 0.3;

export class ImageExtent {
  /** Side of a square on the plane at z = 1 m that has the area of the camera's picture, metres. */
  value = DEFAULT_EXTENT;
  #frame: number | null = null;
  #measured = false;
  #count = 0;
  #sumX = 0;
  #sumY = 0;
  #sumXx = 0;
  #sumYy = 0;

  /** Adds a decoded packet: `count` of the `points` from point `first` on, 4 int16 each. */
  addVertices(frameNumber: number, points: Int16Array, first: number, count: number): void {
    if (frameNumber !== this.#frame) this.#close(frameNumber);
    const step = Math.max(1, Math.floor(count / SAMPLES_PER_PACKET));
    for (let i = first; i < first + count; i += step) {
      this.#add(points[i * 4] as number, points[i * 4 + 1] as number, points[i * 4 + 2] as number);
    }
  }

  /** Adds a points64 packet. @param payload from byte `offset` on: x, y, z as int16 mm of `count` points */
  add(frameNumber: number, payload: DataView, offset: number, count: number): void {
    if (frameNumber !== this.#frame) this.#close(frameNumber);
    const step = Math.max(1, Math.floor(count / SAMPLES_PER_PACKET));
    for (let i = 0; i < count; i += step) {
      const at = offset + i * 6;
      this.#add(payload.getInt16(at, true), payload.getInt16(at + 2, true), payload.getInt16(at + 4, true));
    }
  }

  #add(x: number, y: number, z: number): void {
    if (z <= 0) return;
    const [u, v] = [clamp(x / z), clamp(y / z)];
    this.#count++;
    this.#sumX += u;
    this.#sumY += v;
    this.#sumXx += u * u;
    this.#sumYy += v * v;
  }

  #close(nextFrame: number): void {
    const n = this.#count;
    if (n >= LEAST_SAMPLES) {
      const varianceX = this.#sumXx / n - (this.#sumX / n) ** 2;
      const varianceY = this.#sumYy / n - (this.#sumY / n) ** 2;
      // Points spread evenly over a side a have variance a²/12; the geometric mean of both sides keeps the area.
      const extent = Math.sqrt(12) * Math.max(varianceX * varianceY, 0) ** 0.25;
      this.value += (extent - this.value) * (this.#measured ? SMOOTHING : 1);
      this.#measured = true;
    }
    this.#frame = nextFrame;
    this.#count = 0;
    this.#sumX = 0;
    this.#sumY = 0;
    this.#sumXx = 0;
    this.#sumYy = 0;
  }
}

function clamp(tangent: number): number {
  return Math.min(Math.max(tangent, -MOST_TANGENT), MOST_TANGENT);
}
