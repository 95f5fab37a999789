/**
 * Points on their way from the worker to the page: one buffer, transferred to the page and returned for reuse.
 *
 *     0             `BATCH_PACKETS` entries of 104 bytes, one per packet, in the platform's byte order:
 *                     0 f64 received, ms since the epoch    8 u32 frameNumber   12 u32 frameLength   16 u32 sequenceOffset
 *                    20 u32 points    24 u32 captureTimeUs  28 u32 flags (1 = latency test)
 *                    32 f32 ×3 position of the camera       44 f32 ×4 its orientation x, y, z, w
 *                    60 f32 how wide the camera sees (image-extent.ts)
 *                    64 u32 sequenceLength: the points received, as bytes of the frame; `points` counts those drawn
 *                    68 f32 unit of the coordinates, metres       72 f32 cover: diameter of a point in mean distances
 *                    76 u32 firstTile    80 u32 tiles: 0 if the packet has points    84 u16 ×2 width and height of the image, pixels
 *                    88 f32 ×4 the camera's fx, fy, cx, cy, pixels
 *     POINTS_OFFSET  the packets' points one after another, x, y, z in units and the colour's bits, int16 each;
 *                    or their tiles, 256 samples each, u32: the inverse depth as a half float, 1/m, 0 where nothing was
 *                    seen, in the lower 16 bits, and the colour, 5-6-5 bits, R highest, in the upper
 */
import { type Placement, type PointPacketHeader, pointsOfBytes } from '@farpoint/protocol';

/** Maximum number of packets in a batch. */
export const BATCH_PACKETS = 128;
const ENTRY_BYTES = 104;
const WORDS = ENTRY_BYTES / 4;
const POINTS_OFFSET = BATCH_PACKETS * ENTRY_BYTES;
/** A packet of a coded format may hold any number of points: what does not fit goes into the next batch. */
export const BATCH_POINTS = 65_536;
/** Room that a tile takes, in points. */
export const TILE_ROOM = 128;
/** Maximum number of tiles in a batch. */
export const BATCH_TILES = BATCH_POINTS / TILE_ROOM;
/** Size of a batch's buffer, bytes. */
export const BATCH_BYTES = POINTS_OFFSET + BATCH_POINTS * 4 * Int16Array.BYTES_PER_ELEMENT;
export const ENTRY_LATENCY_TEST = 1;

/** Samples are random: circles with a diameter of c mean distances cover 1 − exp(−π·c²/4) of a surface, 96 % at 2. */
export const SAMPLED_COVER = 2;

/** How a packet's points are to be drawn. */
export interface PointLook {
  /** How wide the camera sees (image-extent.ts). */
  imageExtent: number;
  /** Metres of one step of a coordinate. */
  unit: number;
  /** Diameter in mean distances of the frame's points. */
  cover: number;
}

/** The image that tiles belong to, and the camera that captured it: pixel (u, v) sees along ((u − cx) / fx, (v − cy) / fy, 1). */
export interface TileGrid {
  /** Pixels in a row. */
  width: number;
  /** Rows. */
  height: number;
  /** Focal length across, pixels. */
  fx: number;
  /** Focal length down, pixels. */
  fy: number;
  /** Column of the optical axis. */
  cx: number;
  /** Row of the optical axis. */
  cy: number;
}

/**
 * Decoded points, or tiles of a surface, of one sensor, in one buffer: an entry for each packet, then what the packets
 * hold, one after another. The accessors that take a `packet` expect its index, 0 to `packets` − 1.
 */
export class Batch {
  /** The memory behind all views, `BATCH_BYTES` long. Detached once the batch is released. */
  readonly buffer: ArrayBuffer;
  /** Four numbers per point: x, y, z in steps of {@link unit} in the camera's optical frame, and the colour's bits. */
  readonly points: Int16Array;
  /** The tiles' samples, 256 for each, row by row. */
  readonly samples: Uint32Array;
  readonly #u32: Uint32Array;
  readonly #f32: Float32Array;
  readonly #f64: Float64Array;
  /** Number of packets in the batch. */
  packets = 0;
  /** Number of points of all packets, or the room that their tiles take. */
  pointCount = 0;
  /** Number of the sensor that the points come from. */
  sensor: number;

  /**
   * @param buffer `BATCH_BYTES` long
   * @param packets number of packets that the buffer already holds
   * @param pointCount number of their points, or the room that their tiles take
   * @param sensor number of the sensor that the points come from
   * @throws {RangeError} if the buffer is too small
   */
  constructor(buffer: ArrayBuffer, packets = 0, pointCount = 0, sensor = 0) {
    this.buffer = buffer;
    this.points = new Int16Array(buffer, POINTS_OFFSET);
    this.samples = new Uint32Array(buffer, POINTS_OFFSET);
    this.#u32 = new Uint32Array(buffer, 0, POINTS_OFFSET / 4);
    this.#f32 = new Float32Array(buffer, 0, POINTS_OFFSET / 4);
    this.#f64 = new Float64Array(buffer, 0, POINTS_OFFSET / 8);
    this.packets = packets;
    this.pointCount = pointCount;
    this.sensor = sensor;
  }

  /** Whether no further packet fits. */
  get full(): boolean {
    return this.packets === BATCH_PACKETS;
  }

  /** Number of points that still fit. */
  get room(): number {
    return BATCH_POINTS - this.pointCount;
  }

  /**
   * Adds the entry of one packet, or of a part of one. The caller writes its points, from the batch's point
   * `pointCount` on. The batch must not be full.
   *
   * @param header place in the frame of all points received, drawn or not
   * @param placement pose of the camera, capture time and flags of the frame
   * @param points number of points to draw; no more than there is room for
   * @param receivedAtMs ms since the epoch
   * @param look how the points are to be drawn
   */
  add(
    header: PointPacketHeader,
    placement: Placement,
    points: number,
    receivedAtMs: number,
    look: PointLook,
  ): void {
    const i = this.packets * WORDS;
    this.#f64[i / 2] = receivedAtMs;
    this.#u32[i + 2] = header.frameNumber;
    this.#u32[i + 3] = header.frameLength;
    this.#u32[i + 4] = header.sequenceOffset;
    this.#u32[i + 5] = points;
    this.#u32[i + 6] = placement.captureTimeUs;
    this.#u32[i + 7] = placement.latencyTest ? ENTRY_LATENCY_TEST : 0;
    const { position, orientation } = placement.pose;
    this.#f32[i + 8] = position.x;
    this.#f32[i + 9] = position.y;
    this.#f32[i + 10] = position.z;
    this.#f32[i + 11] = orientation.x;
    this.#f32[i + 12] = orientation.y;
    this.#f32[i + 13] = orientation.z;
    this.#f32[i + 14] = orientation.w;
    this.#f32[i + 15] = look.imageExtent;
    this.#u32[i + 16] = header.sequenceLength;
    this.#f32[i + 17] = look.unit;
    this.#f32[i + 18] = look.cover;
    this.#u32[i + 20] = 0;
    this.packets++;
    this.pointCount += points;
  }

  /**
   * Adds the entry of one packet with tiles, or of a part of one. The caller writes their samples, from the batch's
   * sample `pointCount` · 2 on. The batch must not be full.
   *
   * @param firstTile number of the first tile in the image
   * @param tiles how many; at least 1, no more than there is room for
   * @param grid the image that the tiles belong to
   */
  addTiles(
    header: PointPacketHeader,
    placement: Placement,
    firstTile: number,
    tiles: number,
    receivedAtMs: number,
    look: PointLook,
    grid: TileGrid,
  ): void {
    const i = this.packets * WORDS;
    this.add(header, placement, tiles * TILE_ROOM, receivedAtMs, look);
    this.#u32[i + 19] = firstTile;
    this.#u32[i + 20] = tiles;
    this.#u32[i + 21] = grid.width | (grid.height << 16);
    this.#f32[i + 22] = grid.fx;
    this.#f32[i + 23] = grid.fy;
    this.#f32[i + 24] = grid.cx;
    this.#f32[i + 25] = grid.cy;
  }

  /** Empties the batch. The points stay in the buffer until they are overwritten. */
  clear(): void {
    this.packets = 0;
    this.pointCount = 0;
  }

  /** When the packet arrived, ms since the epoch. */
  receivedAtMs(packet: number): number {
    return this.#f64[packet * (WORDS / 2)] as number;
  }
  /** Number of the frame that the packet belongs to; wraps at 2³². */
  frameNumber(packet: number): number {
    return this.#u32[packet * WORDS + 2] as number;
  }
  /** Size of the whole frame, bytes, 8 per point. */
  frameLength(packet: number): number {
    return this.#u32[packet * WORDS + 3] as number;
  }
  /** Where the packet's points begin in the frame, bytes, 8 per point. */
  sequenceOffset(packet: number): number {
    return this.#u32[packet * WORDS + 4] as number;
  }
  /** Number of the packet's points in this batch, or the room that its tiles take. */
  pointsOf(packet: number): number {
    return this.#u32[packet * WORDS + 5] as number;
  }
  /** Whether it has tiles. A batch that begins with tiles may end with the points of an earlier frame, and vice versa. */
  get hasTiles(): boolean {
    return this.packets > 0 && this.tilesOf(0) > 0;
  }
  /** Number of the packet's tiles in this batch; 0 if it has points. */
  tilesOf(packet: number): number {
    return this.#u32[packet * WORDS + 20] as number;
  }
  /** Number of the packet's first tile in the image. Tiles are numbered row by row. */
  firstTile(packet: number): number {
    return this.#u32[packet * WORDS + 19] as number;
  }
  /** Writes the image that the packet's tiles belong to into `grid`. */
  readGrid(packet: number, grid: TileGrid): void {
    const i = packet * WORDS;
    const size = this.#u32[i + 21] as number;
    grid.width = size & 0xffff;
    grid.height = size >>> 16;
    grid.fx = this.#f32[i + 22] as number;
    grid.fy = this.#f32[i + 23] as number;
    grid.cx = this.#f32[i + 24] as number;
    grid.cy = this.#f32[i + 25] as number;
  }
  /** When the robot captured the frame, on its monotonic clock, µs; wraps at 2³². */
  captureTimeUs(packet: number): number {
    return this.#u32[packet * WORDS + 6] as number;
  }
  /** Whether the frame answers a latency test. */
  isLatencyTest(packet: number): boolean {
    return ((this.#u32[packet * WORDS + 7] as number) & ENTRY_LATENCY_TEST) !== 0;
  }
  /** The camera's field of view, as the side of its picture at a distance of 1 m, metres. */
  imageExtent(packet: number): number {
    return this.#f32[packet * WORDS + 15] as number;
  }
  /** Bytes of the frame that the packet carried, 8 per point, drawn or not. */
  sequenceLength(packet: number): number {
    return this.#u32[packet * WORDS + 16] as number;
  }
  /** Number of points that the packet carried, drawn or not. */
  pointsCame(packet: number): number {
    return pointsOfBytes(this.sequenceLength(packet));
  }
  /** One step of a coordinate, metres. */
  unit(packet: number): number {
    return this.#f32[packet * WORDS + 17] as number;
  }
  /** Diameter at which a point is to be drawn, in mean distances between the frame's points. */
  cover(packet: number): number {
    return this.#f32[packet * WORDS + 18] as number;
  }
  /**
   * The camera's pose when the frame was captured, in the world (REP-103).
   *
   * @param component 0–2: position x, y, z in metres; 3–6: orientation x, y, z, w
   */
  poseComponent(packet: number, component: number): number {
    return this.#f32[packet * WORDS + 8 + component] as number;
  }
}
