import { createHmac, randomBytes } from 'node:crypto';
import {
  makeOperatorKey,
  makeProof,
  type RevocationsPayload,
  signRevocations,
  soleFingerprint,
} from '@farpoint/grants';
import { type GrantedOperator, grantTo, makeIssuer, type TestIssuer } from '@farpoint/grants/testing';
import { attacks } from '../attack.ts';
import { inTime, mustHold, untilTrue } from '../harm.ts';
import { GRANTED_ROBOT, type Scene } from '../scene.ts';

interface Facts {
  session: string;
  offer: string;
  answer: string;
}
type Shown = { grant?: string | undefined; proof?: string | undefined };

const nowS = () => Date.now() / 1000;

async function proven(
  { grant, key }: Pick<GrantedOperator, 'grant' | 'key'>,
  facts: Facts,
  change = {},
): Promise<Shown> {
  const { session, offer, answer } = facts;
  const fingerprints = {
    operatorFingerprint: soleFingerprint(answer) ?? '',
    robotFingerprint: soleFingerprint(offer) ?? '',
  };
  const bound = { robot: GRANTED_ROBOT, session, ...fingerprints, ...change };
  return { grant, proof: await makeProof(grant, bound, key, nowS()) };
}

/** Asks the robot with grants for a session, and must get one refusal and no packet of media. */
async function expectRefused(scene: Scene, credentials: (facts: Facts) => Promise<Shown>): Promise<void> {
  const operator = await scene.asker(GRANTED_ROBOT, { credentials });
  await inTime(
    operator.until(({ type }) => type === 'session.closed'),
    'the robot did not refuse',
  );
  const closed = operator.heard.find(({ type }) => type === 'session.closed');
  mustHold(
    closed?.type === 'session.closed' && closed.reason === 'not-granted',
    'another reason than not-granted',
  );
  mustHold(operator.client.session.length === 0, 'the operator was welcomed');
  mustHold(operator.client.packets === 0, 'the operator got media');
}

/** A JWT with another header, and a signature by the public key as a secret. */
function confused(grant: string, secret: string): string {
  const [, claims] = grant.split('.');
  const header = Buffer.from(JSON.stringify({ alg: 'HS256', kid: 'k1', typ: 'JWT' })).toString('base64url');
  const signed = `${header}.${claims}`;
  return `${signed}.${createHmac('sha256', secret).update(signed).digest('base64url')}`;
}

let sequence = 0;
const payloadOf = (ids: readonly string[]): RevocationsPayload => ({
  iss: 'attacker',
  iat: Math.floor(nowS()),
  seq: Math.floor(nowS()) + ++sequence,
  subjects: [],
  grants: ids.map((jti) => ({ jti, exp: Math.floor(nowS()) + 3600 })),
});
const listOf = ({ signingKey }: TestIssuer, ids: readonly string[]) =>
  signRevocations(payloadOf(ids), signingKey);

const listsTaken = (scene: Scene, outcome: string) =>
  scene.metric('farpoint_robot_revocation_lists_total', `{outcome="${outcome}"}`, GRANTED_ROBOT);
const untilRevoked = (scene: Scene, lists: number) =>
  untilTrue(async () => (await listsTaken(scene, 'taken')) >= lists, 'the robot takes no list of its issuer');

/** At a robot that admits only who has a grant. */
export const grantAttacks = attacks('grants', {
  'no grant': (scene) => expectRefused(scene, async () => ({})),
  'grant without a proof': async (scene) => {
    const { grant } = await grantTo(scene.issuer, nowS());
    await expectRefused(scene, async () => ({ grant }));
  },
  'grant of another issuer under a known name': async (scene) => {
    const granted = await grantTo(await makeIssuer('k1'), nowS());
    await expectRefused(scene, (facts) => proven(granted, facts));
  },
  'grant signed with the public key as a secret': async (scene) => {
    const granted = await grantTo(scene.issuer, nowS());
    const forged = { ...granted, grant: confused(granted.grant, JSON.stringify(scene.issuer.publicJwk)) };
    await expectRefused(scene, (facts) => proven(forged, facts));
  },
  'grant with changed claims': async (scene) => {
    const granted = await grantTo(scene.issuer, nowS(), { role: 'watch' });
    const [header, , seal] = granted.grant.split('.');
    const claims = Buffer.from(JSON.stringify({ ...granted.claims, role: 'supervise' })).toString(
      'base64url',
    );
    await expectRefused(scene, (facts) =>
      proven({ ...granted, grant: `${header}.${claims}.${seal}` }, facts),
    );
  },
  'expired grant': async (scene) => {
    const granted = await grantTo(scene.issuer, nowS() - 7200);
    await expectRefused(scene, (facts) => proven(granted, facts));
  },
  'grant for another robot': async (scene) => {
    const granted = await grantTo(scene.issuer, nowS(), { robots: ['elsewhere-*'] });
    await expectRefused(scene, (facts) => proven(granted, facts));
  },
  'grant of somebody else, with a key of one’s own': async (scene) => {
    const { grant } = await grantTo(scene.issuer, nowS());
    const key = await makeOperatorKey(true);
    await expectRefused(scene, (facts) => proven({ grant, key }, facts));
  },
  'proof for another session': async (scene) => {
    const granted = await grantTo(scene.issuer, nowS());
    const session = randomBytes(16).toString('base64url');
    await expectRefused(scene, (facts) => proven(granted, facts, { session }));
  },
  'proof for another certificate': async (scene) => {
    const granted = await grantTo(scene.issuer, nowS());
    const operatorFingerprint = `sha-256 ${Array.from({ length: 32 }, () => 'AB').join(':')}`;
    await expectRefused(scene, (facts) => proven(granted, facts, { operatorFingerprint }));
  },
  'grant and proof of an earlier session': async (scene) => {
    const granted = await grantTo(scene.issuer, nowS());
    let first: Shown = {};
    const honest = await scene.asker(GRANTED_ROBOT, {
      credentials: async (facts) => {
        first = await proven(granted, facts);
        return first;
      },
    });
    await inTime(honest.client.ready(), 'the owner of the grant gets no session');
    await expectRefused(scene, async () => first);
  },
  'grant that was revoked': async (scene) => {
    const granted = await grantTo(scene.issuer, nowS(), { jti: 'revoked-before' });
    scene.revoke(await listOf(scene.issuer, ['revoked-before']));
    await untilRevoked(scene, 1);
    await expectRefused(scene, (facts) => proven(granted, facts));
  },
  'session that goes on after its grant was revoked': async (scene) => {
    const granted = await grantTo(scene.issuer, nowS(), { jti: 'revoked-during' });
    const operator = await scene.asker(GRANTED_ROBOT, { credentials: (facts) => proven(granted, facts) });
    await inTime(operator.client.ready(), 'the owner of the grant gets no session');
    scene.revoke(await listOf(scene.issuer, ['revoked-during']));
    await inTime(
      operator.until((message) => message.type === 'session.closed' && message.reason === 'grant-revoked'),
      'the session goes on',
      2000,
    );
  },
  'list of revocations by another issuer, or an older one that is empty': async (scene) => {
    const granted = await grantTo(scene.issuer, nowS(), { jti: 'innocent' });
    const operator = await scene.asker(GRANTED_ROBOT, { credentials: (facts) => proven(granted, facts) });
    await inTime(operator.client.ready(), 'the owner of the grant gets no session');
    // What an older list of the issuer's own says is true still: here, nothing.
    const older = { ...payloadOf([]), seq: 1 };
    for (const [list, outcome] of [
      [await listOf(await makeIssuer('k1'), ['innocent']), 'revocations-untrusted'],
      [await listOf(await makeIssuer('k9'), ['innocent']), 'revocations-untrusted'],
      [await signRevocations(older, scene.issuer.signingKey), 'revocations-older'],
    ] as const) {
      const before = await listsTaken(scene, outcome);
      scene.revoke(list);
      await untilTrue(async () => (await listsTaken(scene, outcome)) > before, 'the list was not judged');
    }
    const { length } = operator.client.completeFrames;
    await inTime(
      operator.client.until(() => operator.client.completeFrames.length > length),
      'a session ended by a list that nobody trusts',
    );
  },
  'texts of 4 KB for grant and proof': (scene) =>
    expectRefused(scene, async () => ({
      grant: `${'a'.repeat(1300)}.`.repeat(3).slice(0, -1),
      proof: 'a.b.c',
    })),
});
