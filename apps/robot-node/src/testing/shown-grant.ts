import { makeProof, soleFingerprint } from '@farpoint/grants';
import type { GrantedOperator } from '@farpoint/grants/testing';
import type { Credentials } from './signaled-operator.ts';

type Facts = Parameters<Credentials>[0];
/** What a cheat's proof says instead of the truth. */
export type ChangedFacts = (facts: Facts) => Partial<Facts & { robot: string; madeAtS: number }>;

/** What the holder of a grant shows to a robot. */
export function shownGrant(
  id: string,
  { grant, key }: Pick<GrantedOperator, 'grant' | 'key'>,
  change: ChangedFacts = () => ({}),
): Credentials {
  return async (facts) => {
    const shown = { robot: id, madeAtS: Date.now() / 1000, ...facts, ...change(facts) };
    const { robot, session, offer, answer, madeAtS } = shown;
    const operatorFingerprint = soleFingerprint(answer) ?? '';
    const robotFingerprint = soleFingerprint(offer) ?? '';
    const bound = { robot, session, operatorFingerprint, robotFingerprint };
    return { grant, proof: await makeProof(grant, bound, key, madeAtS) };
  };
}
