/** Signed in, and admitted: a real OpenID Connect provider, the issuer, the signaling service and the running robot. */
import { keyThumbprint, makeOperatorKey, type OperatorKey } from '@farpoint/grants';
import { SignOn, WebBrowser } from '@farpoint/issuer/testing';
import { LocalStack } from '@farpoint/local-stack';
import { parseSignInAnswer, signInAddress } from '@farpoint/protocol';
import { useFolder } from '@farpoint/service/testing/folder';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { shownGrant } from './testing/shown-grant.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';

const ROBOT = 'sim-1';
const PAGE = 'http://localhost:9/';
const folder = useFolder();
let [signOn, stack]: [SignOn | null, LocalStack | null] = [null, null];
const running = () => {
  if (signOn === null || stack === null) throw new Error('not running');
  return { signOn, stack };
};

beforeAll(async () => {
  signOn = await SignOn.start({
    ...{ folder, pages: [PAGE] },
    people: { ada: { name: 'Ada Lovelace', groups: ['drivers'] }, wim: { name: 'Wim', groups: ['guests'] } },
    rules: [
      { claim: 'groups', value: 'drivers', role: 'drive', robots: ['sim-*'] },
      { claim: 'groups', value: 'guests', role: 'watch', robots: ['other-*'] },
    ],
  });
  const light = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'];
  stack = await LocalStack.start({
    signalingArgs: ['--sign-in-url', signOn.signInUrl],
    robots: [{ id: ROBOT, name: 'Simulated robot', args: [...light, '--grant-keys', signOn.keysFile] }],
  });
}, 60_000);
afterAll(async () => {
  await stack?.stop();
  await signOn?.stop();
}, 30_000);

async function grantOf(name: string, key: OperatorKey): Promise<string> {
  const request = { key: await keyThumbprint(key.publicJwk), return: PAGE, state: null };
  const { url } = await new WebBrowser([PAGE]).signIn(
    signInAddress(running().signOn.signInUrl, request),
    name,
  );
  const answer = parseSignInAnswer(url.hash);
  if (answer === null || !('grant' in answer)) throw new Error(`no grant: ${url.href}`);
  return answer.grant;
}

describe('who has signed in', { timeout: 30_000 }, () => {
  it('is told where by the signaling service, admitted by name, and drives', async () => {
    const key = await makeOperatorKey();
    const credentials = shownGrant(ROBOT, { grant: await grantOf('ada', key), key });
    const operator = await SignaledOperator.connect(running().stack.signalingUrl, ROBOT, { credentials });
    try {
      expect(operator.heard).toContainEqual(
        expect.objectContaining({ type: 'operator.welcome', signIn: running().signOn.signInUrl }),
      );
      const { access } = await operator.client.message('welcome');
      expect(access).toMatchObject({ role: 'drive', name: 'Ada Lovelace' });
      await operator.client.takeLease();
    } finally {
      await operator.close();
    }
  });
});
