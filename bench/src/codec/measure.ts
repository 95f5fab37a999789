/** Measures one codec on one cloud. */
import { bitsOfBytes } from '@farpoint/timing';
import { distribution, timeCalls } from '../stats.ts';
import type { BenchCloud, CodecRun } from './adapter.ts';
import { type LossRate, type LossResult, measureLoss } from './loss.ts';
import { verify } from './verify.ts';

export interface CodecRow {
  cloud: string;
  codec: string;
  setting: string;
  /** Number of points in the cloud that have a measurement. */
  validPoints: number;
  /** Number of points sent: fewer if the format cannot represent some. */
  sentPoints: number;
  /** Bits per sent point. */
  bitsPerPoint: number;
  depthErrorMmPerZ2: number;
  depthErrorMm: number;
  colorPsnrDb: number | null;
  encodeMs: number;
  decodeMs: number;
  /** Outside WASM; only if requested and supported by the codec. */
  nativeEncodeMs?: number;
  nativeDecodeMs?: number;
  packets: number;
  maxPacketBytes: number;
  /** Extra bits because each packet is decodable alone, as a share; if the codec reports it. */
  independenceCost?: number;
  /** Passes over a frame to meet a budget, in a steady stream. */
  passes?: number;
  /** Whether one lost packet loses the frame. */
  blob: boolean;
  loss: Record<LossRate, LossResult>;
}

/** Calls until WASM runs at its final speed, because V8 recompiles it while it runs. */
const WARM_UP = 20;

export function measureCodec(cloud: BenchCloud, run: CodecRun, rounds: number, native = false): CodecRow {
  run.encode();
  run.settle?.();
  const packetBytes = run.packetBytes();
  const all = packetBytes.map((_, i) => i);
  run.decode(all);
  const decoded = run.decoded();
  const { depthErrorMmPerZ2, depthErrorMm, worstM, colorPsnrDb } = verify(cloud, decoded);
  const loss = measureLoss(cloud, run, decoded.points, worstM);
  const median = (call: () => void) => distribution(timeCalls(call, rounds, WARM_UP)).p50;
  // Encoding a frame again may give different packets if the encoder learns from it.
  const decodeMs = median(() => run.decode(all));
  const encodeMs = median(() => run.encode());
  const outside = native ? run.native?.(rounds) : undefined;
  const bytes = packetBytes.reduce((sum, size) => sum + size, 0);
  return {
    cloud: cloud.name,
    codec: run.codec,
    setting: run.setting,
    validPoints: cloud.valid.length,
    sentPoints: decoded.points,
    bitsPerPoint: round(bitsOfBytes(bytes) / decoded.points, 3),
    depthErrorMmPerZ2: round(depthErrorMmPerZ2, 4),
    depthErrorMm: round(depthErrorMm, 3),
    colorPsnrDb: colorPsnrDb === null || run.hasColour === false ? null : round(colorPsnrDb, 2),
    encodeMs: round(encodeMs, 3),
    decodeMs: round(decodeMs, 3),
    ...(outside === undefined
      ? {}
      : { nativeEncodeMs: round(outside.encodeMs, 3), nativeDecodeMs: round(outside.decodeMs, 3) }),
    packets: packetBytes.length,
    maxPacketBytes: Math.max(0, ...packetBytes),
    ...(run.independenceCost === undefined ? {} : { independenceCost: round(run.independenceCost(), 4) }),
    ...(run.passes === undefined ? {} : { passes: run.passes() }),
    blob: run.blob,
    loss,
  };
}

function round(value: number, digits: number): number {
  return Number(value.toFixed(digits));
}
