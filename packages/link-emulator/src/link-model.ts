import { CapacitySchedule } from './capacity.ts';
import type { CrossFlow } from './cross-flow.ts';
import { BIN_MS, type DropReason, type LinkBin, LinkStatistics } from './link-statistics.ts';
import { BurstLossProcess } from './loss.ts';
import { PacketHeap, PacketRing, type QueuedPacket } from './packet-queue.ts';
import { checkProfile, JITTER_SLOT_MS, LEAST_QUEUE_BYTES, type LinkProfile } from './profile.ts';
import { hashUniform, Random } from './random.ts';

/** What a link tells its user, from within {@link LinkModel.advance} and {@link LinkModel.offer}. It must not call back. */
export interface LinkSink {
  /**
   * A packet comes out at the far end.
   *
   * @param handle as it was offered
   * @param atMs the exact instant
   * @param queueMs from its arrival until its last bit had left the bottleneck
   */
  delivered(handle: number, atMs: number, queueMs: number): void;
  /** The packet being offered was taken twice: it will be delivered once more. */
  duplicated(handle: number): void;
}

export interface LinkModelOptions {
  readonly profile: LinkProfile;
  readonly seed: number;
  /** The capacity's time 0, and the earliest time of a packet. */
  readonly startMs: number;
  readonly sink: LinkSink;
  /** Traffic that shares the link. */
  readonly crossFlows?: readonly CrossFlow[];
  /** Called once for each {@link BIN_MS}; bins begin at multiples of it. */
  readonly onBin?: (bin: LinkBin) => void;
}

const PEERS = -1;
const NEVER = Number.POSITIVE_INFINITY;
/** Less than this many bits is a rounding error. */
const NO_BITS = 1e-6;

/**
 * One direction of a link in virtual time: loss, a drop-tail queue, a bottleneck of varying capacity, propagation. Times
 * are milliseconds of one clock that may only go forward; bytes are bytes on the wire. Amortised constant time for each
 * packet (a packet that is overtaken: logarithmic in how many are), no allocation but for those.
 */
export class LinkModel {
  readonly #sink: LinkSink;
  readonly #onBin: ((bin: LinkBin) => void) | null;
  readonly #flows: readonly CrossFlow[];
  readonly #senders: readonly ((handle: number, wireBytes: number) => boolean)[];
  readonly #seed: number;
  readonly #lossRandom: Random;
  readonly #burstRandom: Random;
  readonly #delayRandom: Random;
  readonly #copyRandom: Random;
  readonly #burst = new BurstLossProcess();
  readonly #queue = new PacketRing();
  readonly #ordered = new PacketRing();
  readonly #strays = new PacketHeap();
  readonly #statistics = new LinkStatistics();
  readonly #packet: QueuedPacket = { timeMs: 0, bytes: 0, owner: 0, handle: 0, queueMs: 0 };
  readonly #changes: { atMs: number; profile: LinkProfile }[] = [];
  #profile: LinkProfile;
  #originMs: number;
  #schedule: CapacitySchedule;
  /** A second reader of the same capacity, for what lies behind. */
  #ledger: CapacitySchedule;
  #nowMs: number;
  #paused = false;
  #blackhole = false;
  #backlogBytes = 0;
  /** Of the packet being sent. */
  #remainingBits = 0;
  /** Until when its sending is reckoned. */
  #servedMs = 0;
  #serviceMs = NEVER;
  #serviceEnds = false;
  /** Latest capacity above 0, bits per millisecond. */
  #knownRate = 0;
  #latestDueMs = Number.NEGATIVE_INFINITY;
  #binMs: number;
  #binCapacityBits = 0;
  #reckonedMs: number;

  /** @throws {ProfileError | CapacityError} */
  constructor(options: LinkModelOptions) {
    const { profile, seed, startMs } = options;
    checkProfile(profile);
    this.#profile = profile;
    this.#seed = seed;
    this.#sink = options.sink;
    this.#onBin = options.onBin ?? null;
    this.#flows = options.crossFlows ?? [];
    this.#senders = this.#flows.map(
      (_, owner) => (handle, wireBytes) => this.#enter(wireBytes, owner, handle) === null,
    );
    this.#lossRandom = new Random(seed, 1);
    this.#burstRandom = new Random(seed, 2);
    this.#delayRandom = new Random(seed, 3);
    this.#copyRandom = new Random(seed, 4);
    this.#originMs = startMs;
    this.#nowMs = startMs;
    this.#schedule = new CapacitySchedule(profile.capacity, startMs);
    this.#ledger = new CapacitySchedule(profile.capacity, startMs);
    this.#binMs = Math.floor(startMs / BIN_MS) * BIN_MS;
    this.#reckonedMs = this.#binMs;
  }

  get profile(): LinkProfile {
    return this.#profile;
  }

  /** Waiting at the bottleneck, the packet being sent included. */
  get backlogBytes(): number {
    return this.#backlogBytes;
  }

  /** Before this instant nothing is delivered, unless something more is offered or changed. */
  get wakeMs(): number {
    const leastDelay = Math.max(0, this.#profile.delayMs - this.#profile.jitterMs);
    const changeMs = this.#changes[0]?.atMs ?? NEVER;
    return Math.min(this.#ordered.headMs, this.#strays.headMs, this.#serviceMs + leastDelay, changeMs);
  }

  /**
   * A packet arrives.
   *
   * @param wireBytes headers included
   * @param handle returned with its delivery: an integer of 32 bits
   * @returns why the link drops it, or `null` where it will be delivered
   */
  offer(wireBytes: number, nowMs: number, handle: number): DropReason | null {
    this.advance(nowMs);
    this.#statistics.offeredBytes += wireBytes;
    this.#statistics.offeredPackets++;
    const reason = this.#enter(wireBytes, PEERS, handle);
    if (reason !== null) {
      this.#statistics.dropped(reason);
    } else if (this.#copyRandom.chance(this.#profile.duplicate)) {
      if (this.#admit(wireBytes, PEERS, handle)) this.#sink.duplicated(handle);
    }
    return reason;
  }

  /** Lets everything happen that is due by then, in order. */
  advance(nowMs: number): void {
    for (;;) {
      const { atMs, flow } = this.#nextFlow();
      const outMs = Math.min(this.#ordered.headMs, this.#strays.headMs);
      const changeMs = this.#changes[0]?.atMs ?? NEVER;
      const binEndMs = this.#onBin === null ? NEVER : this.#binMs + BIN_MS;
      const eventMs = Math.min(atMs, outMs, this.#serviceMs, changeMs, binEndMs);
      if (eventMs > nowMs || eventMs === NEVER) break;
      this.#nowMs = Math.max(this.#nowMs, eventMs);
      if (eventMs === binEndMs) this.#closeBin();
      else if (eventMs === changeMs) this.#apply(this.#changes.shift()!.profile, this.#originMs);
      else if (eventMs === outMs) this.#deliver();
      else if (eventMs === this.#serviceMs) this.#serve();
      else this.#flows[flow]!.run(this.#nowMs, this.#senders[flow]!);
    }
    if (nowMs > this.#nowMs) this.#nowMs = nowMs;
  }

  /** From then on, or from now where that is past, the link is as this says; what waits or flies stays. @throws {ProfileError | CapacityError} */
  setProfile(profile: LinkProfile, atMs: number): void {
    checkProfile(profile);
    new CapacitySchedule(profile.capacity, this.#originMs);
    if (atMs <= this.#nowMs) {
      this.#apply(profile, this.#originMs);
      return;
    }
    const index = this.#changes.findIndex((change) => change.atMs > atMs);
    this.#changes.splice(index === -1 ? this.#changes.length : index, 0, { atMs, profile });
  }

  /** The capacity's time 0 is now. */
  restart(nowMs: number): void {
    this.advance(nowMs);
    this.#apply(this.#profile, nowMs);
  }

  /** Stops or resumes serving: packets wait, and overflow the queue. */
  pause(paused: boolean, nowMs: number): void {
    this.advance(nowMs);
    this.#settle();
    this.#paused = paused;
    this.#plan();
  }

  /** Drops every packet at the entrance, or none any more. What waits is still delivered. */
  blackhole(active: boolean, nowMs: number): void {
    this.advance(nowMs);
    this.#blackhole = active;
  }

  #enter(wireBytes: number, owner: number, handle: number): DropReason | null {
    const { burstLoss, loss } = this.#profile;
    let reason: DropReason | null = null;
    if (this.#blackhole) reason = 'blackhole';
    else if (burstLoss !== null && this.#burst.loses(burstLoss, this.#burstRandom)) reason = 'burst-loss';
    else if (this.#lossRandom.chance(loss)) reason = 'loss';
    else if (!this.#admit(wireBytes, owner, handle)) reason = 'queue-full';
    if (reason !== null && owner !== PEERS) this.#statistics.crossDrops++;
    return reason;
  }

  #admit(wireBytes: number, owner: number, handle: number): boolean {
    if (this.#backlogBytes + wireBytes > this.#limitBytes()) return false;
    this.#queue.push(this.#nowMs, wireBytes, owner, handle, 0);
    this.#backlogBytes += wireBytes;
    if (this.#queue.length === 1) this.#begin(this.#nowMs);
    return true;
  }

  #limitBytes(): number {
    const { queue } = this.#profile;
    if ('bytes' in queue) return queue.bytes;
    this.#schedule.seek(this.#nowMs);
    if (this.#schedule.rate > 0) this.#knownRate = this.#schedule.rate;
    return Math.max(LEAST_QUEUE_BYTES, (queue.ms * this.#knownRate) / 8);
  }

  #begin(atMs: number): void {
    this.#remainingBits = this.#queue.headBytes * 8;
    this.#servedMs = atMs;
    this.#plan();
  }

  /** When the packet being sent is through, or the capacity changes. */
  #plan(): void {
    this.#serviceMs = NEVER;
    if (this.#queue.length === 0 || this.#paused) return;
    const schedule = this.#schedule;
    schedule.seek(this.#servedMs);
    const endMs = this.#servedMs + (schedule.rate > 0 ? this.#remainingBits / schedule.rate : NEVER);
    this.#serviceEnds = endMs <= schedule.segmentEndMs;
    this.#serviceMs = this.#serviceEnds ? endMs : schedule.segmentEndMs;
  }

  #serve(): void {
    const atMs = this.#serviceMs;
    if (!this.#serviceEnds) {
      this.#reckonService(atMs);
      if (this.#remainingBits > NO_BITS) {
        this.#plan();
        return;
      }
    }
    this.#queue.shift(this.#packet);
    this.#backlogBytes -= this.#packet.bytes;
    this.#depart(atMs);
    if (this.#queue.length > 0) this.#begin(atMs);
    else this.#serviceMs = NEVER;
  }

  #depart(atMs: number): void {
    const { timeMs, bytes, owner, handle } = this.#packet;
    const queueMs = atMs - timeMs;
    if (owner === PEERS) this.#statistics.departed(bytes, queueMs);
    else this.#statistics.crossBytes += bytes;
    const { delayMs, jitterMs, jitterReorders, reorder } = this.#profile;
    let dueMs = atMs + delayMs;
    if (jitterMs > 0) {
      const uniform = jitterReorders
        ? this.#delayRandom.next()
        : hashUniform(this.#seed, Math.floor((atMs - this.#originMs) / JITTER_SLOT_MS));
      dueMs = Math.max(atMs, dueMs + (2 * uniform - 1) * jitterMs);
    }
    if (this.#delayRandom.chance(reorder.probability)) {
      this.#strays.push(dueMs + reorder.extraMs, bytes, owner, handle, queueMs);
    } else if (jitterReorders) {
      this.#strays.push(dueMs, bytes, owner, handle, queueMs);
    } else {
      this.#latestDueMs = Math.max(this.#latestDueMs, dueMs);
      this.#ordered.push(this.#latestDueMs, bytes, owner, handle, queueMs);
    }
  }

  #deliver(): void {
    const from = this.#ordered.headMs <= this.#strays.headMs ? this.#ordered : this.#strays;
    from.shift(this.#packet);
    const { owner, handle, timeMs, queueMs } = this.#packet;
    if (owner === PEERS) this.#sink.delivered(handle, timeMs, queueMs);
    else this.#flows[owner]!.delivered(handle, timeMs);
  }

  #nextFlow(): { atMs: number; flow: number } {
    const next = NEXT_FLOW;
    next.atMs = NEVER;
    for (let flow = 0; flow < this.#flows.length; flow++) {
      const atMs = this.#flows[flow]!.nextMs;
      if (atMs < next.atMs) {
        next.atMs = atMs;
        next.flow = flow;
      }
    }
    return next;
  }

  #apply(profile: LinkProfile, originMs: number): void {
    this.#settle();
    this.#profile = profile;
    this.#originMs = originMs;
    this.#schedule = new CapacitySchedule(profile.capacity, originMs);
    this.#ledger = new CapacitySchedule(profile.capacity, originMs);
    this.#plan();
  }

  /** Brings every account up to now, before the rules change. */
  #settle(): void {
    this.#reckonCapacity(this.#nowMs);
    if (this.#queue.length > 0) this.#reckonService(this.#nowMs);
  }

  #reckonService(atMs: number): void {
    if (!this.#paused && atMs > this.#servedMs) {
      this.#schedule.seek(this.#servedMs);
      this.#remainingBits = Math.max(0, this.#remainingBits - this.#schedule.rate * (atMs - this.#servedMs));
    }
    this.#servedMs = atMs;
  }

  #reckonCapacity(atMs: number): void {
    if (!this.#paused) this.#binCapacityBits += this.#ledger.bitsBetween(this.#reckonedMs, atMs);
    this.#reckonedMs = atMs;
  }

  #closeBin(): void {
    const endMs = this.#binMs + BIN_MS;
    this.#reckonCapacity(endMs);
    const oldestMs = this.#queue.length === 0 ? 0 : endMs - this.#queue.headMs;
    this.#onBin?.(this.#statistics.close(this.#binMs, this.#binCapacityBits, this.#backlogBytes, oldestMs));
    this.#binCapacityBits = 0;
    this.#binMs = endMs;
  }
}

/** Lent out for one comparison at a time. */
const NEXT_FLOW = { atMs: NEVER, flow: 0 };
