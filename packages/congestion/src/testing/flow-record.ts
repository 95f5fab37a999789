import type { DropReason, FlowListener } from '@farpoint/network-sim';
import type { RateController } from '../rate-controller.ts';

/** Width of the bins, ms. */
export const BIN_MS = 100;

/** Records what a flow did, for the measures of a scenario. */
export class FlowRecord implements FlowListener {
  readonly name: string;
  /** Bytes by time of arrival, in bins of BIN_MS. */
  readonly arrivedBytes: number[] = [];
  /** Packets by time of sending: all, dropped by the full queue, lost otherwise. */
  readonly sentPackets: number[] = [];
  readonly overflowed: number[] = [];
  readonly lost: number[] = [];
  /** Every packet that arrived: when it was sent, how long it waited, how old its picture was on arrival, ms. */
  readonly packetMs: number[] = [];
  readonly queueMs: number[] = [];
  readonly ageMs: number[] = [];
  /** Samples of the controller after every update. */
  readonly sampleMs: number[] = [];
  readonly target: number[] = [];
  readonly state: string[] = [];

  constructor(name: string) {
    this.name = name;
  }

  sent(_bytes: number, nowMs: number): void {
    add(this.sentPackets, nowMs, 1);
  }

  dropped(sentMs: number, reason: DropReason): void {
    add(reason === 'queue-full' ? this.overflowed : this.lost, sentMs, 1);
  }

  /** @param createdMs creation time of the picture that the packet carries */
  delivered(bytes: number, sentMs: number, arrivalMs: number, queueMs: number, createdMs = sentMs): void {
    this.packetMs.push(sentMs);
    this.queueMs.push(queueMs);
    this.ageMs.push(arrivalMs - createdMs);
    add(this.arrivedBytes, arrivalMs, bytes);
  }

  sample(nowMs: number, controller: RateController): void {
    this.sampleMs.push(nowMs);
    this.target.push(controller.targetBitsPerSecond(nowMs));
    this.state.push(controller.snapshot(nowMs).state);
  }
}

function add(bins: number[], timeMs: number, amount: number): void {
  const bin = Math.floor(timeMs / BIN_MS);
  while (bins.length <= bin) bins.push(0);
  bins[bin] = (bins[bin] as number) + amount;
}

/** The sum of the bins that begin in [from, to). */
export function sumBins(bins: readonly number[], fromMs: number, toMs: number): number {
  let sum = 0;
  for (let bin = Math.ceil(fromMs / BIN_MS); bin < Math.ceil(toMs / BIN_MS); bin++) sum += bins[bin] ?? 0;
  return sum;
}
