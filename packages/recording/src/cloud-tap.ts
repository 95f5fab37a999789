import type { MessagePort } from 'node:worker_threads';
import type { CloudFormat, Pose } from '@farpoint/protocol';
import { CloudRate } from './cloud-rate.ts';
import { CreditQueue } from './credit-queue.ts';
import type { Destinations } from './message-outputs.ts';
import type { CloudAnswer, CloudKind, CloudRecord, CloudWishes, Lens } from './recorder-messages.ts';

/** How many clouds of each kind the writer may hold, and how many may wait for it. */
const LIMITS = { underWay: 2, waiting: 4 };

/** A captured cloud: as points, or as a depth camera's images. */
export type TappedCloud = { cameraPose: Pose; capturedAtMs: number } & (
  | { form: 'points'; points: Float32Array; count: number }
  | { form: 'images'; depth: Float32Array; colour: Uint32Array }
);

export interface TapGrid {
  width: number;
  height: number;
  camera: Lens | null;
}

/** A frame's packets as they are sent. */
export interface TappedPackets {
  format: CloudFormat;
  points: number;
  packets: number;
  slotBytes: number;
  streamHeader: Uint8Array | null;
  copyPackets: (into: Uint8Array, packets: number) => void;
}

/**
 * The capture thread's end of a recording. Copies each cloud into memory that is transferred to the writer thread and
 * comes back. Bounded: if the writer does not keep up, the oldest waiting cloud is dropped.
 */
export class CloudTap {
  readonly #port: MessagePort;
  readonly #lanes: Record<CloudKind, Lane>;
  readonly #rates: Record<'file' | 'live', Record<CloudKind, CloudRate>>;
  #wishes: CloudWishes = { file: true, live: { captured: false, sent: false } };

  /**
   * @param perSecond the most clouds of each kind recorded per second: 0 records none, infinity all
   * @param livePerSecond the same for live viewers, who get a kind only while one of them subscribes to it
   */
  constructor(port: MessagePort, perSecond: Readonly<Record<CloudKind, number>>, livePerSecond = 0) {
    this.#port = port;
    this.#lanes = { captured: new Lane(port), sent: new Lane(port) };
    this.#rates = {
      file: { captured: new CloudRate(perSecond.captured), sent: new CloudRate(perSecond.sent) },
      live: { captured: new CloudRate(livePerSecond), sent: new CloudRate(livePerSecond) },
    };
    port.on('message', ({ wishes, done }: CloudAnswer) => {
      this.#wishes = wishes;
      if (done !== null) this.#lanes[done.kind].done(done.buffer);
    });
  }

  /** Clouds that were not recorded because the writer did not keep up. */
  get dropped(): number {
    return this.#lanes.captured.dropped + this.#lanes.sent.dropped;
  }

  /** Clouds that the writer holds or that wait for it. */
  get pending(): number {
    return this.#lanes.captured.pending + this.#lanes.sent.pending;
  }

  /** Whether clouds are copied for a file, by what the writer last said: it comes by another way than the file's opening. */
  get recording(): boolean {
    return this.#wishes.file;
  }

  captured(cloud: TappedCloud, { width, height, camera }: TapGrid): void {
    const { capturedAtMs, cameraPose: pose } = cloud;
    const to = this.#destinations('captured', capturedAtMs);
    if (to === null) return;
    const lane = this.#lanes.captured;
    if (cloud.form === 'points') {
      const { points, count } = cloud;
      if (points.length < count * 4) {
        lane.miss();
        return;
      }
      lane.push(
        count * 16,
        (buffer) => new Float32Array(buffer).set(points.subarray(0, count * 4)),
        (stamp) => ({ type: 'points', ...stamp, to, capturedAtMs, pose, count, width, height }),
      );
    } else if (camera !== null) {
      const { depth, colour } = cloud;
      if (depth.length !== width * height || colour.length !== width * height) {
        lane.miss();
        return;
      }
      const lens = { fx: camera.fx, fy: camera.fy, cx: camera.cx, cy: camera.cy };
      lane.push(
        width * height * 8,
        (buffer) => {
          new Float32Array(buffer).set(depth);
          new Uint32Array(buffer).set(colour, width * height);
        },
        (stamp) => ({ type: 'images', ...stamp, to, capturedAtMs, pose, lens, width, height }),
      );
    }
  }

  sent(
    { capturedAtMs, cameraPose: pose }: Pick<TappedCloud, 'capturedAtMs' | 'cameraPose'>,
    frame: TappedPackets,
  ): void {
    const to = this.#destinations('sent', capturedAtMs);
    if (to === null) return;
    const { format, points, packets, slotBytes, streamHeader, copyPackets } = frame;
    this.#lanes.sent.push(
      packets * slotBytes,
      (buffer) => copyPackets(new Uint8Array(buffer), packets),
      (stamp) => ({
        type: 'sent',
        ...stamp,
        to,
        capturedAtMs,
        pose,
        format,
        points,
        packets,
        slotBytes,
        streamHeader,
      }),
    );
  }

  /** @returns `null` if nobody gets the cloud, so that it is not copied */
  #destinations(kind: CloudKind, capturedAtMs: number): Destinations | null {
    const file = this.#wishes.file && this.#rates.file[kind].takes(capturedAtMs);
    const live = this.#wishes.live[kind] && this.#rates.live[kind].takes(capturedAtMs);
    return file || live ? { file, live } : null;
  }

  /** Waiting clouds are still written. */
  close(): void {
    this.#lanes.captured.drain();
    this.#lanes.sent.drain();
    this.#port.close();
  }
}

type Stamp = Pick<CloudRecord, 'sequence' | 'dropped' | 'buffer'>;

/** Clouds of one kind, and the memory in which they are transferred. */
class Lane {
  readonly #queue: CreditQueue<CloudRecord>;
  readonly #free: ArrayBuffer[] = [];
  #made = 0;
  #sequence = 0;
  #unmade = 0;

  constructor(port: MessagePort) {
    this.#queue = new CreditQueue(LIMITS, (record) => port.postMessage(record, [record.buffer]));
    this.#queue.onDrop = ({ buffer }) => this.#free.push(buffer);
  }

  get dropped(): number {
    return this.#queue.dropped + this.#unmade;
  }

  /** Memory that is not free is in transfer or waits. */
  get pending(): number {
    return this.#made - this.#free.length;
  }

  push(bytes: number, fill: (buffer: ArrayBuffer) => void, make: (stamp: Stamp) => CloudRecord): void {
    const sequence = this.#sequence++;
    const buffer = this.#take(bytes);
    if (buffer === null) {
      this.#unmade++;
      return;
    }
    fill(buffer);
    this.#queue.push(make({ sequence, dropped: this.dropped, buffer }));
  }

  /** Counts a cloud whose memory is no longer available. */
  miss(): void {
    this.#sequence++;
    this.#unmade++;
  }

  done(buffer: ArrayBuffer): void {
    this.#free.push(buffer);
    this.#queue.done();
  }

  drain(): void {
    this.#queue.drain();
  }

  #take(bytes: number): ArrayBuffer | null {
    if (this.#free.length === 0) {
      if (this.#made < LIMITS.underWay + LIMITS.waiting) this.#made++;
      else if (!this.#queue.dropOldest()) return null;
    }
    const buffer = this.#free.pop();
    // Slightly larger than requested: clouds vary in size, and the memory is reused.
    return buffer !== undefined && buffer.byteLength >= bytes
      ? buffer
      : new ArrayBuffer(Math.ceil(bytes * 0.3) * 4);
  }
}
