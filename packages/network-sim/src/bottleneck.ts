import { bitsOfBytes, bytesOfBits } from '@farpoint/timing';
import { CapacitySchedule, type CapacitySpec } from './capacity.ts';
import { PacketRing, type QueuedPacket } from './packet-queue.ts';
import { LEAST_QUEUE_BYTES, type QueueLimit } from './profile.ts';

const NEVER = Number.POSITIVE_INFINITY;
/** Fewer bits than this are a rounding error. */
const NO_BITS = 1e-6;

/**
 * A drop-tail queue in front of a link of varying capacity. Each packet's bits are integrated over the capacity, so
 * that a change, a pause or an outage takes effect in the middle of a packet.
 */
export class Bottleneck {
  readonly #queue = new PacketRing();
  #limit: QueueLimit;
  #schedule: CapacitySchedule;
  /** A second reader of the same capacity, for the time already past. */
  #ledger: CapacitySchedule;
  #reckonedMs: number;
  #capacityBits = 0;
  #paused = false;
  #backlogBytes = 0;
  /** Of the packet being sent. */
  #remainingBits = 0;
  /** The time up to which its transmission is accounted for. */
  #servedMs = 0;
  #nextMs = NEVER;
  #packetEnds = false;
  /** Latest capacity above 0, bits per millisecond. */
  #knownRate = 0;

  /**
   * @param originMs the capacity's time 0
   * @param reckonedMs the time from which {@link takeCapacityBits} counts
   * @throws {CapacityError}
   */
  constructor(capacity: CapacitySpec, limit: QueueLimit, originMs: number, reckonedMs = originMs) {
    this.#limit = limit;
    this.#schedule = new CapacitySchedule(capacity, originMs);
    this.#ledger = new CapacitySchedule(capacity, originMs);
    this.#reckonedMs = reckonedMs;
  }

  /** When the packet being sent is complete, or the capacity changes during it: call {@link serve} then. */
  get nextMs(): number {
    return this.#nextMs;
  }

  /** Waiting bytes, including the packet being sent. */
  get backlogBytes(): number {
    return this.#backlogBytes;
  }

  /** When the packet being sent arrived; Infinity if there is none. */
  get oldestMs(): number {
    return this.#queue.headMs;
  }

  /** A packet arrives. @returns false if the queue is full */
  admit(nowMs: number, bytes: number, owner: number, handle: number): boolean {
    if (this.#backlogBytes + bytes > this.#limitBytes(nowMs)) return false;
    this.#queue.push(nowMs, bytes, owner, handle, 0);
    this.#backlogBytes += bytes;
    if (this.#queue.length === 1) this.#begin(nowMs);
    return true;
  }

  /** Does what is due at {@link nextMs}. @returns whether a packet has left, which is then in `out` */
  serve(out: QueuedPacket): boolean {
    const atMs = this.#nextMs;
    if (!this.#packetEnds) {
      this.#reckonService(atMs);
      if (this.#remainingBits > NO_BITS) {
        this.#plan();
        return false;
      }
    }
    this.#queue.shift(out);
    this.#backlogBytes -= out.bytes;
    if (this.#queue.length > 0) this.#begin(atMs);
    else this.#nextMs = NEVER;
    return true;
  }

  /** Changes the link from now on; waiting packets stay. @throws {CapacityError} */
  change(capacity: CapacitySpec, limit: QueueLimit, originMs: number, nowMs: number): void {
    this.#settle(nowMs);
    this.#schedule = new CapacitySchedule(capacity, originMs);
    this.#ledger = new CapacitySchedule(capacity, originMs);
    this.#limit = limit;
    this.#plan();
  }

  /** Stops or resumes serving. */
  pause(paused: boolean, nowMs: number): void {
    this.#settle(nowMs);
    this.#paused = paused;
    this.#plan();
  }

  /** Bits that the link could have carried since the last call. */
  takeCapacityBits(nowMs: number): number {
    this.#reckonCapacity(nowMs);
    const bits = this.#capacityBits;
    this.#capacityBits = 0;
    return bits;
  }

  #limitBytes(nowMs: number): number {
    if ('bytes' in this.#limit) return this.#limit.bytes;
    this.#schedule.seek(nowMs);
    if (this.#schedule.rate > 0) this.#knownRate = this.#schedule.rate;
    return Math.max(LEAST_QUEUE_BYTES, bytesOfBits(this.#limit.ms * this.#knownRate));
  }

  #begin(atMs: number): void {
    this.#remainingBits = bitsOfBytes(this.#queue.headBytes);
    this.#servedMs = atMs;
    this.#plan();
  }

  #plan(): void {
    this.#nextMs = NEVER;
    if (this.#queue.length === 0 || this.#paused) return;
    const schedule = this.#schedule;
    schedule.seek(this.#servedMs);
    const endMs = this.#servedMs + (schedule.rate > 0 ? this.#remainingBits / schedule.rate : NEVER);
    this.#packetEnds = endMs <= schedule.segmentEndMs;
    this.#nextMs = this.#packetEnds ? endMs : schedule.segmentEndMs;
  }

  /** Brings all accounting up to now, before the rules change. */
  #settle(nowMs: number): void {
    this.#reckonCapacity(nowMs);
    if (this.#queue.length > 0) this.#reckonService(nowMs);
  }

  #reckonService(atMs: number): void {
    if (!this.#paused && atMs > this.#servedMs) {
      this.#schedule.seek(this.#servedMs);
      this.#remainingBits = Math.max(0, this.#remainingBits - this.#schedule.rate * (atMs - this.#servedMs));
    }
    this.#servedMs = atMs;
  }

  #reckonCapacity(atMs: number): void {
    if (!this.#paused) this.#capacityBits += this.#ledger.bitsBetween(this.#reckonedMs, atMs);
    this.#reckonedMs = atMs;
  }
}
