/** What remains of a frame when packets are lost. */

import { Random } from '@farpoint/network-sim';
import type { BenchCloud, CodecRun } from './adapter.ts';
import { verify } from './verify.ts';

export type LossRate = '1' | '5' | '20';
const RATES: readonly LossRate[] = ['1', '5', '20'];

export interface LossResult {
  /** Share of the sent points that did not arrive, 0–1. */
  pointsLost: number;
  /** Share of the received points that are further from their place than any point is without loss, 0–1. */
  pointsWrong: number;
}

/** Number of frames decoded to look for wrong points. */
const DECODED_SEEDS = 3;
/** Number of frames over which received points are counted, packet by packet. */
const COUNTED_SEEDS = 1000;

/** @param worstM tolerance for a point: the largest error without loss */
export function measureLoss(
  cloud: BenchCloud,
  run: CodecRun,
  sent: number,
  worstM: number,
): Record<LossRate, LossResult> {
  const packets = run.packetBytes().length;
  const points = run.blob ? [] : pointsOfPackets(run, packets);
  const results = RATES.map((rate): [LossRate, LossResult] => {
    const share = Number(rate) / 100;
    if (run.blob) {
      let lost = 0;
      for (let seed = 1; seed <= COUNTED_SEEDS; seed++)
        if (survivors(packets, share, seed).length < packets) lost++;
      return [rate, { pointsLost: lost / COUNTED_SEEDS, pointsWrong: 0 }];
    }
    let [came, wrong] = [0, 0];
    for (let seed = 1; seed <= DECODED_SEEDS; seed++) {
      const present = survivors(packets, share, seed);
      run.decode(present);
      const decoded = run.decoded();
      const expected = present.reduce((sum, packet) => sum + (points[packet] as number), 0);
      // A packet that decodes differently among others than alone is not independently decodable.
      if (decoded.points !== expected) throw new Error(`${decoded.points} points in place of ${expected}`);
      came += decoded.points;
      wrong += verify(cloud, decoded, worstM * 1.001 + 1e-6).wrong;
    }
    let counted = 0;
    for (let seed = 1; seed <= COUNTED_SEEDS; seed++) {
      for (const packet of survivors(packets, share, seed)) counted += points[packet] as number;
    }
    return [
      rate,
      { pointsLost: 1 - counted / (sent * COUNTED_SEEDS), pointsWrong: came === 0 ? 0 : wrong / came },
    ];
  });
  return Object.fromEntries(results) as Record<LossRate, LossResult>;
}

/** Number of points in each packet, decoded alone. */
function pointsOfPackets(run: CodecRun, packets: number): number[] {
  return Array.from({ length: packets }, (_, packet) => {
    run.decode([packet]);
    return run.decoded().points;
  });
}

/** The packets that arrive, in random order. */
function survivors(packets: number, lossRate: number, seed: number): number[] {
  const random = new Random(seed, 0);
  const come: number[] = [];
  for (let packet = 0; packet < packets; packet++) if (random.next() >= lossRate) come.push(packet);
  for (let i = come.length - 1; i > 0; i--) {
    const j = Math.floor(random.next() * (i + 1));
    [come[i], come[j]] = [come[j] as number, come[i] as number];
  }
  return come;
}
