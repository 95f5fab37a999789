import { describe, expect, test } from 'vitest';
import { type BannerFacts, bannerWords } from './banner-words.ts';

const live: BannerFacts = {
  phase: 'live',
  silence: 'heard',
  interrupted: false,
  signaling: 'ready',
  online: true,
  robotListed: true,
  robotId: 'rover-1',
  lastLoss: null,
  maxOperators: null,
  lossDetail: null,
  gripped: false,
  gripLost: null,
  takenOverBy: null,
};
const lost = { ...live, silence: 'lost', interrupted: true } as const;
const waiting = { ...live, phase: 'waiting', silence: 'lost' } as const;
const titleOf = (facts: BannerFacts) => bannerWords(facts)?.title ?? null;

describe('within a session', () => {
  test('nothing is said while the robot is heard, or has only just fallen silent', () => {
    expect(bannerWords(live)).toBeNull();
    expect(bannerWords({ ...live, silence: 'unheard' })).toBeNull();
  });

  test('the signaling service tells which side is gone', () => {
    expect(titleOf(lost)).toBe('The robot does not answer');
    expect(titleOf({ ...lost, robotListed: false })).toBe('The robot is gone');
    // Without the service nobody knows of the robot: what it listed last says nothing.
    for (const signaling of ['waiting', 'connecting'] as const)
      expect(titleOf({ ...lost, robotListed: false, signaling })).toBe('Your connection is lost');
    expect(titleOf({ ...lost, online: false })).toBe('Your connection is lost');
  });

  test('each says that the robot stops, what happens next, and to let go of a grip that is held', () => {
    for (const more of [{}, { robotListed: false }, { online: false }]) {
      const banner = bannerWords({ ...lost, ...more });
      expect(banner?.urgent).toBe(true);
      expect(banner?.text).toMatch(/stops by itself\. This page (keeps trying|connects again)/);
      expect(banner?.text).not.toContain('Let go');
      expect(bannerWords({ ...lost, ...more, gripped: true })?.text).toMatch(/Let go of the grip\.$/);
    }
  });

  test('a robot that is heard but does not hear is told of', () => {
    expect(titleOf({ ...live, interrupted: true })).toBe('The robot does not hear you');
  });

  test('a hand that holds on in vain learns why, politely; a lost link matters more', () => {
    expect(bannerWords({ ...live, gripLost: 'path-lost' })).toMatchObject({
      title: 'Let go of the grip',
      urgent: false,
    });
    const taken = { ...live, takenOverBy: 'Grace', gripLost: 'other-drives' } as const;
    expect(bannerWords(taken)?.text).toMatch(/^Grace has taken over .*Let go of the grip\.$/);
    expect(bannerWords({ ...taken, takenOverBy: '' })?.text).toMatch(/^Another operator has/);
    expect(titleOf({ ...taken, silence: 'lost' })).toBe('The robot does not answer');
  });
});

describe('without a session', () => {
  test('nothing is said while none is wanted, while the first opens, and where a panel asks for a decision', () => {
    expect(bannerWords({ ...waiting, phase: 'none' })).toBeNull();
    expect(bannerWords(waiting)).toBeNull();
    expect(bannerWords({ ...waiting, phase: 'opening' })).toBeNull();
    expect(bannerWords({ ...waiting, lastLoss: 'not-granted' })).toBeNull();
  });

  test('a robot that the service does not list is named', () => {
    expect(bannerWords({ ...waiting, robotListed: false })?.text).toContain('“rover-1”');
    // The list has not come yet.
    expect(bannerWords({ ...waiting, robotListed: false, signaling: 'connecting' })).toBeNull();
  });

  test('a service that cannot be reached or refuses the token is named', () => {
    expect(bannerWords({ ...waiting, signaling: 'waiting' })?.title).toBe('No signaling service');
    expect(bannerWords({ ...waiting, signaling: 'refused' })?.text).toContain('token');
  });

  test('after a loss it stays until the next session, and says what is known', () => {
    expect(titleOf({ ...waiting, lastLoss: 'silent' })).toBe('Not connected');
    expect(titleOf({ ...waiting, phase: 'opening', lastLoss: 'silent' })).toBe('Not connected');
    expect(titleOf({ ...waiting, lastLoss: 'robot-stopped', robotListed: false })).toBe(
      'The robot is offline',
    );
    expect(titleOf({ ...waiting, lastLoss: 'silent', signaling: 'waiting' })).toBe('Your connection is lost');
    const full = bannerWords({ ...waiting, lastLoss: 'robot-full', maxOperators: 4 });
    expect(full).toMatchObject({ title: 'The robot is full', text: expect.stringContaining('4 operators') });
  });
});
