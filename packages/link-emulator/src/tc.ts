/** The same profile for the Linux kernel: arguments of `tc qdisc`, where iproute2 and the kernel can express it. Pure. */
import { LEAST_QUEUE_BYTES, type LinkProfile, ProfileError } from './profile.ts';

/** Packets that netem may hold: more than any delay here needs. */
const NETEM_PACKETS = 200_000;
/** tbf has no rate of 0. */
const LEAST_BITS_PER_SECOND = 1000;
/** So long may tbf send at line rate after a pause, ms; never less than two packets. */
const BURST_MS = 1;

/**
 * What follows `tc qdisc add dev DEVICE`, in this order: netem for what happens to single packets, tbf for capacity and
 * queue behind it. Capacity is that of the moment: see {@link tcRate} for later.
 *
 * Differences from the model: netem's jitter always reorders, and its reordering sends packets early instead of late.
 *
 * @throws {ProfileError} for what netem cannot do
 */
export function tcQdiscs(profile: LinkProfile, mbps: number): string[][] {
  const netem = netemArguments(profile);
  const qdiscs: string[][] = [];
  if (netem.length > 0) {
    qdiscs.push(['root', 'handle', '1:', 'netem', 'limit', String(NETEM_PACKETS), ...netem]);
  }
  if (mbps !== Number.POSITIVE_INFINITY) {
    qdiscs.push([...tcRatePlace(profile), 'handle', '10:', ...tcRate(profile, mbps)]);
  }
  return qdiscs;
}

/** Where {@link tcRate} belongs: `tc qdisc change dev DEVICE` + this + `handle 10:` + that. */
export function tcRatePlace(profile: LinkProfile): string[] {
  return netemArguments(profile).length > 0 ? ['parent', '1:1'] : ['root'];
}

/** tbf for this capacity, 10^6 bit/s. */
export function tcRate(profile: LinkProfile, mbps: number): string[] {
  const bitsPerSecond = Math.max(LEAST_BITS_PER_SECOND, Math.round(mbps * 1e6));
  const burst = Math.max(LEAST_QUEUE_BYTES, Math.ceil((bitsPerSecond * BURST_MS) / 8000));
  const { queue } = profile;
  const limit =
    'bytes' in queue
      ? queue.bytes
      : Math.max(LEAST_QUEUE_BYTES, Math.ceil((queue.ms * bitsPerSecond) / 8000));
  return ['tbf', 'rate', `${bitsPerSecond}bit`, 'burst', String(burst), 'limit', String(limit)];
}

function netemArguments(profile: LinkProfile): string[] {
  const { delayMs, jitterMs, loss, burstLoss, reorder, duplicate } = profile;
  const args: string[] = [];
  if (delayMs > 0 || jitterMs > 0 || reorder.probability > 0) {
    args.push('delay', `${delayMs}ms`, ...(jitterMs > 0 ? [`${jitterMs}ms`] : []));
  }
  if (loss > 0 && burstLoss !== null)
    throw new ProfileError('loss: netem takes independent or burst loss, not both');
  if (loss > 0) args.push('loss', 'random', percent(loss));
  if (burstLoss !== null) {
    const { enter, leave, lossWhenBad, lossWhenGood } = burstLoss;
    args.push('loss', 'gemodel', percent(enter), percent(leave), percent(lossWhenBad), percent(lossWhenGood));
  }
  if (reorder.probability > 0) args.push('reorder', percent(reorder.probability));
  if (duplicate > 0) args.push('duplicate', percent(duplicate));
  return args;
}

function percent(probability: number): string {
  return `${Number((probability * 100).toFixed(6))}%`;
}
