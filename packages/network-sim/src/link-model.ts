import { Bottleneck } from './bottleneck.ts';
import { CapacitySchedule } from './capacity.ts';
import type { CrossFlow } from './cross-flow.ts';
import { BIN_MS, type DropReason, type LinkBin, LinkStatistics } from './link-statistics.ts';
import { PacketLoss } from './loss.ts';
import type { QueuedPacket } from './packet-queue.ts';
import { checkProfile, type LinkProfile } from './profile.ts';
import { Propagation } from './propagation.ts';
import { Random } from './random.ts';

/**
 * The events that a link reports from within {@link LinkModel.advance} and {@link LinkModel.offer}. The sink must not
 * call back.
 */
export interface LinkSink {
  /**
   * A packet arrives at the far end.
   *
   * @param handle as given to `offer`
   * @param atMs the exact instant
   * @param queueMs from its arrival until its last bit had left the bottleneck
   */
  delivered(handle: number, atMs: number, queueMs: number): void;
  /** The offered packet was duplicated: it will be delivered once more. */
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
/**
 * One direction of a link in virtual time: loss, a drop-tail queue, a bottleneck of varying capacity, propagation.
 * Times are milliseconds of one clock that only moves forward; bytes are bytes on the wire. Each packet costs amortised
 * constant time and no allocation. An overtaken packet costs an allocation and time logarithmic in the number of such
 * packets.
 */
export class LinkModel {
  readonly #sink: LinkSink;
  readonly #onBin: ((bin: LinkBin) => void) | null;
  readonly #flows: readonly CrossFlow[];
  readonly #senders: readonly ((handle: number, wireBytes: number) => boolean)[];
  readonly #loss: PacketLoss;
  readonly #copyRandom: Random;
  readonly #bottleneck: Bottleneck;
  readonly #propagation: Propagation;
  readonly #statistics = new LinkStatistics();
  readonly #packet: QueuedPacket = { timeMs: 0, bytes: 0, owner: 0, handle: 0, queueMs: 0 };
  readonly #changes: { atMs: number; profile: LinkProfile }[] = [];
  #profile: LinkProfile;
  /** The capacity's time 0. */
  #originMs: number;
  #nowMs: number;
  #blackhole = false;
  #binMs: number;

  /** @throws {ProfileError | CapacityError} */
  constructor(options: LinkModelOptions) {
    const { profile, seed, startMs } = options;
    checkProfile(profile);
    this.#profile = profile;
    this.#sink = options.sink;
    this.#onBin = options.onBin ?? null;
    this.#flows = options.crossFlows ?? [];
    this.#senders = this.#flows.map(
      (_, owner) => (handle, wireBytes) => this.#enter(wireBytes, owner, handle) === null,
    );
    this.#loss = new PacketLoss(seed);
    this.#propagation = new Propagation(seed);
    this.#copyRandom = new Random(seed, 4);
    this.#originMs = startMs;
    this.#nowMs = startMs;
    this.#binMs = Math.floor(startMs / BIN_MS) * BIN_MS;
    this.#bottleneck = new Bottleneck(profile.capacity, profile.queue, startMs, this.#binMs);
  }

  get profile(): LinkProfile {
    return this.#profile;
  }

  /** Waiting bytes at the bottleneck, including the packet being sent. */
  get backlogBytes(): number {
    return this.#bottleneck.backlogBytes;
  }

  /** Nothing is delivered before this instant, unless something else is offered or changed. */
  get wakeMs(): number {
    const leastDelay = Math.max(0, this.#profile.delayMs - this.#profile.jitterMs);
    const changeMs = this.#changes[0]?.atMs ?? NEVER;
    return Math.min(this.#propagation.headMs, this.#bottleneck.nextMs + leastDelay, changeMs);
  }

  /**
   * A packet arrives.
   *
   * @param wireBytes including headers
   * @param handle returned with its delivery: a 32-bit integer
   * @returns why the link drops it, or `null` if it will be delivered
   */
  offer(wireBytes: number, nowMs: number, handle: number): DropReason | null {
    this.advance(nowMs);
    this.#statistics.offeredBytes += wireBytes;
    this.#statistics.offeredPackets++;
    const reason = this.#enter(wireBytes, PEERS, handle);
    if (reason !== null) {
      this.#statistics.dropped(reason);
    } else if (this.#copyRandom.chance(this.#profile.duplicate)) {
      if (this.#bottleneck.admit(this.#nowMs, wireBytes, PEERS, handle)) this.#sink.duplicated(handle);
    }
    return reason;
  }

  /** Processes everything that is due up to this time, in order. */
  advance(nowMs: number): void {
    for (;;) {
      const { atMs, flow } = this.#nextFlow();
      const outMs = this.#propagation.headMs;
      const serviceMs = this.#bottleneck.nextMs;
      const changeMs = this.#changes[0]?.atMs ?? NEVER;
      const binEndMs = this.#onBin === null ? NEVER : this.#binMs + BIN_MS;
      const eventMs = Math.min(atMs, outMs, serviceMs, changeMs, binEndMs);
      if (eventMs > nowMs || eventMs === NEVER) break;
      this.#nowMs = Math.max(this.#nowMs, eventMs);
      if (eventMs === binEndMs) this.#closeBin();
      else if (eventMs === changeMs) this.#apply(this.#changes.shift()!.profile, this.#originMs);
      else if (eventMs === outMs) this.#deliver();
      else if (eventMs === serviceMs) this.#serve();
      else this.#flows[flow]!.run(this.#nowMs, this.#senders[flow]!);
    }
    if (nowMs > this.#nowMs) this.#nowMs = nowMs;
  }

  /**
   * Changes the link from then on, or from now if that is past; packets that are waiting or in flight stay.
   *
   * @throws {ProfileError | CapacityError}
   */
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

  /** Makes now the capacity's time 0. */
  restart(nowMs: number): void {
    this.advance(nowMs);
    this.#apply(this.#profile, nowMs);
  }

  /** Stops or resumes serving: packets wait, and overflow the queue. */
  pause(paused: boolean, nowMs: number): void {
    this.advance(nowMs);
    this.#bottleneck.pause(paused, this.#nowMs);
  }

  /** Starts or stops dropping every packet at the entrance. Waiting packets are still delivered. */
  blackhole(active: boolean, nowMs: number): void {
    this.advance(nowMs);
    this.#blackhole = active;
  }

  #enter(wireBytes: number, owner: number, handle: number): DropReason | null {
    let reason: DropReason | null = this.#blackhole ? 'blackhole' : this.#loss.next(this.#profile);
    if (reason === null && !this.#bottleneck.admit(this.#nowMs, wireBytes, owner, handle))
      reason = 'queue-full';
    if (reason !== null && owner !== PEERS) this.#statistics.crossDrops++;
    return reason;
  }

  #serve(): void {
    const atMs = this.#bottleneck.nextMs;
    const packet = this.#packet;
    if (!this.#bottleneck.serve(packet)) return;
    if (packet.owner === PEERS) this.#statistics.departed(packet.bytes, atMs - packet.timeMs);
    else this.#statistics.crossBytes += packet.bytes;
    this.#propagation.enter(packet, atMs, this.#profile, this.#originMs);
  }

  #deliver(): void {
    this.#propagation.shift(this.#packet);
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
    this.#bottleneck.change(profile.capacity, profile.queue, originMs, this.#nowMs);
    this.#profile = profile;
    this.#originMs = originMs;
  }

  #closeBin(): void {
    const endMs = this.#binMs + BIN_MS;
    const capacityBits = this.#bottleneck.takeCapacityBits(endMs);
    const { backlogBytes, oldestMs } = this.#bottleneck;
    const oldestAgeMs = oldestMs === NEVER ? 0 : endMs - oldestMs;
    this.#onBin?.(this.#statistics.close(this.#binMs, capacityBits, backlogBytes, oldestAgeMs));
    this.#binMs = endMs;
  }
}

/** A shared object, used for one comparison at a time. */
const NEXT_FLOW = { atMs: NEVER, flow: 0 };
