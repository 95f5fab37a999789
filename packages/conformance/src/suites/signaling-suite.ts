import { readFileSync } from 'node:fs';
import { type Exchange, playExchange } from '../exchange.ts';
import type { ConformanceCase } from './suite.ts';

/** A service's two ports. */
export interface SignalingTarget {
  robot: string;
  client: string;
}

const { exchanges } = JSON.parse(
  readFileSync(new URL('../../vectors/signaling.json', import.meta.url), 'utf8'),
) as { exchanges: Exchange[] };

export const signalingSuite: readonly ConformanceCase<SignalingTarget>[] = exchanges.map((exchange) => ({
  name: exchange.name,
  run: (target) => playExchange(exchange, target),
}));
