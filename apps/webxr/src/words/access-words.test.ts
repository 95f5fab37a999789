import { finalLosses } from '@farpoint/operator';
import { describe, expect, it } from 'vitest';
import { grantWords, obstacleOf } from './access-words.ts';
import { grantEndsWords } from './words.ts';

const key = (letter: string) => letter.repeat(43);
const changed = { robotId: 'r1', known: key('a'), shown: key('b'), byGrant: false };

describe('obstacles', () => {
  it('there is one for each loss that is final, and for no other', () => {
    for (const loss of finalLosses) expect(obstacleOf(loss, null, null)?.title).not.toBe('');
    for (const loss of [null, 'silent', 'robot-full'] as const)
      expect(obstacleOf(loss, null, null)).toBeNull();
  });

  it('tells what the robot said, and offers grants', () => {
    expect(obstacleOf('not-granted', 'the grant has expired', null)).toMatchObject({
      text: expect.stringContaining('The robot says: the grant has expired.'),
      needsGrant: true,
    });
  });

  it('offers a sign-in where there is one, and names its host', () => {
    expect(obstacleOf('not-granted', null, null, 'https://issuer.example:8443/sign-in')).toMatchObject({
      ...{ signInHost: 'issuer.example:8443', text: expect.stringContaining('Sign in to get one.') },
    });
    expect(obstacleOf('not-granted', null, null)).toMatchObject({ signInHost: null });
    expect(obstacleOf('robot-unproven', null, null, 'https://issuer.example/')).toMatchObject({
      signInHost: null,
    });
  });

  it('lets the operator trust a new key only where no grant names another', () => {
    const keys = { known: key('a'), shown: key('b') };
    expect(obstacleOf('robot-key-changed', '', changed)).toMatchObject({ mayTrust: true, keys });
    const byGrant = obstacleOf('robot-key-changed', '', { ...changed, byGrant: true });
    expect(byGrant).toMatchObject({ mayTrust: false, text: expect.stringContaining('your grant') });
    expect(obstacleOf('robot-unproven', 'no proof', null)).toMatchObject({ mayTrust: false, keys: null });
  });
});

describe('grants', () => {
  const claims = {
    ...{ iss: 'test', sub: 'ada', name: 'Ada', aud: 'farpoint', iat: 0, nbf: 0, exp: 100, jti: 'g' },
    ...{ robots: ['kitchen-*', 'hall'], role: 'watch' as const, cnf: { jkt: key('k') } },
  };
  it('are told in a line', () => {
    const date = (ms: number) => `<${ms}>`;
    expect(grantWords(claims, 50, date)).toEqual({
      text: 'Ada may watch: kitchen-*, hall, until <100000>',
      tone: 'neutral',
    });
    expect(grantWords(claims, 100, date)).toMatchObject({
      text: expect.stringContaining('ended'),
      tone: 'warning',
    });
  });

  it('are spoken of in their last minute', () => {
    expect(grantEndsWords(null)).toBeNull();
    expect(grantEndsWords(60_001)).toBeNull();
    expect(grantEndsWords(900)?.text).toContain('in 1 s');
    expect(grantEndsWords(-5)?.text).toContain('in 0 s');
  });
});
