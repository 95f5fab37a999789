import { finalLosses, lossOf } from '@farpoint/operator';
import { commandRejections, driveStates, robotEndReasons } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import {
  driveStateWords,
  holderWords,
  linkWords,
  vrUnavailable,
  wordsOfLoss,
  wordsOfRejection,
} from './words.ts';

const live = {
  phase: 'live',
  signaling: 'ready',
  robotListed: true,
  lastLoss: null,
  maxOperators: null,
  lossDetail: null,
  grantLeftMs: null,
  silentMs: 20,
  silence: 'heard',
  pointsSilentMs: 20,
  plays: false,
  rateByReports: false,
} as const;

const unsaid = { maxOperators: null, lossDetail: null };

describe('words', () => {
  test('there is a text for every state and refusal of the protocol', () => {
    for (const state of driveStates) expect(driveStateWords({ drive: state }).text).not.toBe('');
    for (const reason of commandRejections) expect(wordsOfRejection(reason, 'other')).not.toBe('');
    for (const reason of robotEndReasons) expect(wordsOfLoss(lossOf[reason], unsaid)).not.toBe('');
  });

  test('says which supervisor ended a session', () => {
    const said = { ...unsaid, lossDetail: 'Sue ended the session' };
    expect(wordsOfLoss('ended-by-supervisor', said)).toContain('Sue ended the session.');
    expect(wordsOfLoss('ended-by-supervisor', unsaid)).toContain('A supervisor');
  });

  test('says that a robot is full, and how many operators it takes', () => {
    expect(wordsOfLoss('robot-full', { ...unsaid, maxOperators: 4 })).toContain('4 operators at most');
    expect(wordsOfLoss('robot-full', unsaid)).toContain('full');
    const waiting = { ...live, phase: 'waiting', lastLoss: 'robot-full', maxOperators: 4 } as const;
    expect(linkWords(waiting).text).toContain('4 operators at most');
    const lossDetail = 'somebody with a higher role needed the place';
    expect(linkWords({ ...waiting, lossDetail }).text).toContain(lossDetail);
    expect(linkWords({ ...waiting, robotListed: false }).text).toContain('offline');
    expect(linkWords({ ...waiting, lastLoss: 'silent' }).text).toBe('Connecting…');
  });

  test('the link’s line names the most serious problem', () => {
    expect(linkWords(live)).toEqual({ text: 'Live', tone: 'good' });
    expect(linkWords({ ...live, plays: true }).text).toBe('Playback');
    expect(linkWords({ ...live, signaling: 'waiting' }).text).toContain('signaling offline');
    expect(linkWords({ ...live, rateByReports: true }).text).toContain('cautious rate');
    expect(linkWords({ ...live, pointsSilentMs: 3000 }).text).toContain('no points are arriving');
    expect(linkWords({ ...live, silentMs: 4200, silence: 'lost', pointsSilentMs: 4200 })).toEqual({
      text: 'Connection lost for 4 s',
      tone: 'bad',
    });
    expect(linkWords({ ...live, phase: 'waiting', robotListed: false }).text).toContain('offline');
    expect(linkWords({ ...live, phase: 'none', signaling: 'refused' }).tone).toBe('bad');
  });

  test('speaks of a grant in its last minute, and of a loss that is final', () => {
    expect(linkWords({ ...live, grantLeftMs: 61_000 }).text).toBe('Live');
    expect(linkWords({ ...live, grantLeftMs: 59_400 })).toMatchObject({
      text: expect.stringContaining('ends in 60 s'),
      tone: 'warning',
    });
    // That the robot is out of reach is worse.
    expect(linkWords({ ...live, grantLeftMs: 9000, silentMs: 4000, silence: 'lost' }).tone).toBe('bad');
    const waiting = { ...live, phase: 'waiting' } as const;
    for (const lastLoss of finalLosses) expect(linkWords({ ...waiting, lastLoss }).tone).toBe('bad');
  });

  test('says by name who drives, and what a grant allows', () => {
    const facts = {
      heard: true,
      holder: 'other',
      driver: 'Grace',
      role: 'drive',
      device: null,
      gripLost: null,
      paused: false,
      stopped: false,
    } as const;
    expect(holderWords(facts).text).toBe('Grace is driving');
    // Without a word from the robot nobody knows who drives.
    expect(holderWords({ ...facts, heard: false })).toEqual({
      text: 'The robot does not hear you',
      tone: 'bad',
    });
    expect(holderWords({ ...facts, driver: null }).text).toBe('Someone else is driving');
    expect(holderWords({ ...facts, holder: 'nobody', role: 'watch' }).text).toContain('lets you watch');
    expect(holderWords({ ...facts, holder: 'you', device: 'gamepad' }).text).toContain('gamepad');
    expect(holderWords({ ...facts, holder: 'you', paused: true }).text).toContain('Hold on');
    const stopped = { ...facts, holder: 'you', stopped: true } as const;
    expect(holderWords({ ...stopped, device: 'headset' }).text).toContain('STOP is on');
    expect(holderWords({ ...stopped, gripLost: 'late-reading' }).text).toContain('release it, then drive');
    expect(holderWords(stopped).text).toBe('You have control');
    expect(holderWords({ ...facts, holder: 'you', gripLost: 'late-reading' })).toEqual({
      text: 'Let go of the grip, then drive',
      tone: 'warning',
    });
  });

  test('says why VR is unavailable', () => {
    expect(vrUnavailable({ secure: true, hasWebXr: true, supported: true })).toBe(null);
    expect(vrUnavailable({ secure: false, hasWebXr: false, supported: false })).toContain('https');
    expect(vrUnavailable({ secure: true, hasWebXr: false, supported: false })).toContain('WebXR');
    expect(vrUnavailable({ secure: true, hasWebXr: true, supported: false })).toContain('headset');
  });
});
