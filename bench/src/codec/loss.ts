/** What is left of a frame when packets are lost. */
import type { BenchCloud, CodecRun } from './adapter.ts';
import { verify } from './verify.ts';

export type LossRate = '1' | '5' | '20';
const RATES: readonly LossRate[] = ['1', '5', '20'];

export interface LossResult {
  /** Share of the sent points that did not come, 0–1. */
  pointsLost: number;
  /** Share of the points that came which lie further from their place than any does without loss, 0–1. */
  pointsWrong: number;
}

const SEEDS = 3;
/** Frames of a blob, which need no decoding. */
const BLOB_SEEDS = 500;

/** @param worstM how far off a point may be: the most without loss */
export function measureLoss(
  cloud: BenchCloud,
  run: CodecRun,
  sent: number,
  worstM: number,
): Record<LossRate, LossResult> {
  const packets = run.packetBytes().length;
  const results = RATES.map((rate): [LossRate, LossResult] => {
    const share = Number(rate) / 100;
    if (run.blob) {
      let lost = 0;
      for (let seed = 1; seed <= BLOB_SEEDS; seed++)
        if (survivors(packets, share, seed).length < packets) lost++;
      return [rate, { pointsLost: lost / BLOB_SEEDS, pointsWrong: 0 }];
    }
    let [came, wrong] = [0, 0];
    for (let seed = 1; seed <= SEEDS; seed++) {
      run.decode(survivors(packets, share, seed));
      const decoded = run.decoded();
      came += decoded.points;
      wrong += verify(cloud, decoded, worstM * 1.001 + 1e-6).wrong;
    }
    return [rate, { pointsLost: 1 - came / (sent * SEEDS), pointsWrong: came === 0 ? 0 : wrong / came }];
  });
  return Object.fromEntries(results) as Record<LossRate, LossResult>;
}

/** The packets that come, in a random order. */
function survivors(packets: number, lossRate: number, seed: number): number[] {
  const random = generator(seed);
  const come: number[] = [];
  for (let packet = 0; packet < packets; packet++) if (random() >= lossRate) come.push(packet);
  for (let i = come.length - 1; i > 0; i--) {
    const j = Math.floor(random() * (i + 1));
    [come[i], come[j]] = [come[j] as number, come[i] as number];
  }
  return come;
}

/** mulberry32: 0 up to 1. */
function generator(seed: number): () => number {
  let state = seed * 0x9e37_79b9;
  return () => {
    state = (state + 0x6d2b_79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4_294_967_296;
  };
}
