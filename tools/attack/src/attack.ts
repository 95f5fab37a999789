import type { Scene } from './scene.ts';

export const LAYERS = [
  'dtls',
  'ice',
  'srtp',
  'sctp',
  'peer',
  'session',
  'grants',
  'signaling',
  'reference',
  'http',
  'bridge',
  'files',
] as const;
export type Layer = (typeof LAYERS)[number];

/** One thing that somebody may try. */
export interface Attack {
  readonly name: string;
  readonly layer: Layer;
  /**
   * Tries it once; a `Tally` that it resolves to is printed. Whether it did harm is then judged by facts; see {@link Scene.harm}.
   *
   * @throws {HarmError} if the attack itself sees its effect
   * @throws {NotTriedError} if what it needs is not here
   */
  readonly run: (scene: Scene) => Promise<unknown>;
}

/** Attacks of one layer. */
export function attacks(layer: Layer, all: Readonly<Record<string, Attack['run']>>): Attack[] {
  return Object.entries(all).map(([name, run]) => ({ name, layer, run }));
}
