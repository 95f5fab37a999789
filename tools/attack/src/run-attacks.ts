import type { Attack, Layer } from './attack.ts';
import { inTime, NotTriedError } from './harm.ts';
import { Tally } from './repeat/repeated.ts';
import { Scene } from './scene.ts';

export type Outcome = 'held' | 'harmed' | 'not tried';

export interface AttackResult {
  name: string;
  layer: Layer;
  outcome: Outcome;
  /** What harm it did, or why it was not tried; `null` if everything held. */
  detail: string | null;
  /** What it has sent and measured; `null` if it counts nothing. */
  tally: Tally | null;
  /** How long the attack and the judgement took, s. */
  seconds: number;
}

const ATTACK_MS = 45_000;

/** Runs attacks one after another. After one that did harm, the programs are started anew. */
export async function runAttacks(
  attacks: readonly Attack[],
  onResult: (result: AttackResult) => void,
  start: () => Promise<Scene> = Scene.start,
): Promise<AttackResult[]> {
  const results: AttackResult[] = [];
  // The misbehaving operators run on werift without our checks, and may stumble over what comes back.
  const ignore = () => undefined;
  process.on('unhandledRejection', ignore);
  let scene: Scene | null = null;
  try {
    for (const attack of attacks) {
      scene ??= await start();
      const result = await runAttack(attack, scene);
      results.push(result);
      onResult(result);
      if (result.outcome === 'harmed') {
        await scene.stop();
        scene = null;
      }
    }
  } finally {
    await scene?.stop();
    process.off('unhandledRejection', ignore);
  }
  return results;
}

async function runAttack({ name, layer, run }: Attack, scene: Scene): Promise<AttackResult> {
  const begun = performance.now();
  let tally: Tally | null = null;
  const failure = await inTime(run(scene), 'the attack does not end', ATTACK_MS).then(
    (outcome) => {
      tally = outcome instanceof Tally ? outcome : null;
      return null;
    },
    (error: unknown) => error,
  );
  const harm = await scene.harm();
  const seconds = (performance.now() - begun) / 1000;
  const facts = { name, layer, tally, seconds };
  if (harm !== null) return { ...facts, outcome: 'harmed', detail: harm };
  if (failure === null) return { ...facts, outcome: 'held', detail: null };
  const detail = failure instanceof Error ? failure.message : String(failure);
  return { ...facts, outcome: failure instanceof NotTriedError ? 'not tried' : 'harmed', detail };
}
