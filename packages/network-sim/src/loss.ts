import { Random } from './random.ts';

/** Gilbert–Elliott: two states, stepped once for each packet (Gilbert 1960, Elliott 1963). */
export interface BurstLoss {
  /** Probability of going from good to bad, per packet. */
  readonly enter: number;
  /** Probability of going from bad to good, per packet. */
  readonly leave: number;
  readonly lossWhenBad: number;
  readonly lossWhenGood: number;
}

/**
 * The Gilbert model with this fraction of packets lost, in bursts of this mean length.
 *
 * @param rate 0 to less than 1
 * @param meanBurst packets, 1 or more
 * @throws {RangeError} if no such process exists
 */
export function burstLossOf(rate: number, meanBurst: number): BurstLoss {
  const leave = 1 / meanBurst;
  const enter = (rate * leave) / (1 - rate);
  if (!(rate >= 0 && rate < 1 && meanBurst >= 1 && enter <= 1)) {
    throw new RangeError(`there is no burst loss of ${rate} in bursts of ${meanBurst} packets`);
  }
  return { enter, leave, lossWhenBad: 1, lossWhenGood: 0 };
}

/** The state of one Gilbert–Elliott process. */
export class BurstLossProcess {
  #bad = false;

  /** Steps to the next packet. */
  loses(model: BurstLoss, random: Random): boolean {
    this.#bad = this.#bad ? !random.chance(model.leave) : random.chance(model.enter);
    return random.chance(this.#bad ? model.lossWhenBad : model.lossWhenGood);
  }
}

/** Losses that do not depend on the queue. */
export interface LossModel {
  /** Independent losses, 0 to 1 per packet. */
  readonly loss: number;
  readonly burstLoss: BurstLoss | null;
}

/** Both kinds of loss, each with its own random stream. */
export class PacketLoss {
  readonly #random: Random;
  readonly #burstRandom: Random;
  readonly #burst = new BurstLossProcess();

  constructor(seed: number) {
    this.#random = new Random(seed, 1);
    this.#burstRandom = new Random(seed, 2);
  }

  /** Steps to the next packet. @returns why it is lost, or `null` if it is not */
  next({ loss, burstLoss }: LossModel): 'loss' | 'burst-loss' | null {
    if (burstLoss !== null && this.#burst.loses(burstLoss, this.#burstRandom)) return 'burst-loss';
    return this.#random.chance(loss) ? 'loss' : null;
  }
}
