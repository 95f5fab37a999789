import { makeProof, soleFingerprint } from '@farpoint/grants';
import type { GrantedOperator } from '@farpoint/grants/testing';
import type { Credentials } from './signaled-operator.ts';

/** What the holder of a grant shows to a robot. */
export function shownGrant(
  robot: string,
  { grant, key }: Pick<GrantedOperator, 'grant' | 'key'>,
): Credentials {
  return async ({ session, offer, answer }) => {
    const facts = {
      ...{ robot, session },
      operatorFingerprint: soleFingerprint(answer) ?? '',
      robotFingerprint: soleFingerprint(offer) ?? '',
    };
    return { grant, proof: await makeProof(grant, facts, key, Date.now() / 1000) };
  };
}
