import type { OperatorSessionMessage, Sound } from '@farpoint/protocol';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { VoiceMicrophone } from './open-microphone.ts';
import { RobotSound, type VoiceStatus } from './robot-sound.ts';

const SOUND: Sound = { type: 'sound', mid: '1', voice: { state: 'closed' } };

function bench() {
  const sent: OperatorSessionMessage[] = [];
  const statuses: VoiceStatus[] = [];
  const replaced: (string | null)[] = [];
  const stopped: string[] = [];
  const tracks: string[] = [];
  const asked: PromiseWithResolvers<VoiceMicrophone>[] = [];
  const sound = new RobotSound(
    {
      send: (message) => sent.push(message),
      onVoice: (status) => statuses.push(status),
      onTrack: ({ id }) => tracks.push(id),
    },
    () => {
      const answer = Promise.withResolvers<VoiceMicrophone>();
      asked.push(answer);
      return answer.promise;
    },
  );
  const microphone = (id: string): VoiceMicrophone => ({
    track: { id, enabled: true, readyState: 'live' } as MediaStreamTrack,
    stop: () => stopped.push(id),
  });
  const connect = (track = { id: 'robot' } as MediaStreamTrack) => {
    sound.connect({
      track,
      receiver: { getSynchronizationSources: () => [] },
      sender: {
        replaceTrack: async (track) => void replaced.push(track?.id ?? null),
      },
    });
    sound.latest = SOUND;
  };
  const grant = async (id = 'mic') => {
    asked.at(-1)?.resolve(microphone(id));
    await vi.advanceTimersByTimeAsync(0);
  };
  return { sound, sent, statuses, replaced, stopped, tracks, asked, connect, grant };
}

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

const held = { type: 'speak', held: true };
const letGo = { type: 'speak', held: false };

describe('the operator’s voice', () => {
  it('is sent while the key is held, and no longer', async () => {
    const { sound, sent, replaced, asked, connect, grant } = bench();
    connect();
    expect(asked).toHaveLength(0);
    sound.press();
    expect([sent, replaced]).toEqual([[], []]);
    await grant();
    expect([sent, replaced]).toEqual([[held], ['mic']]);
    expect(sound.voice).toEqual({ held: true, sending: true, failure: null });
    await vi.advanceTimersByTimeAsync(500);
    expect(sent).toEqual([held, held, held]);
    sound.release();
    expect(sent.at(-1)).toEqual(letGo);
    expect(replaced).toEqual(['mic', null]);
    await vi.advanceTimersByTimeAsync(1000);
    expect(sent).toHaveLength(4);
  });

  it('is not sent if the key was let go while the operator was asked', async () => {
    const { sound, sent, replaced, connect, grant } = bench();
    connect();
    sound.press();
    sound.release();
    await grant();
    expect([sent, replaced]).toEqual([[], []]);
  });

  it('uses the microphone again for a while, and then gives it back', async () => {
    const { sound, stopped, asked, connect, grant } = bench();
    connect();
    sound.press();
    await grant();
    sound.release();
    await vi.advanceTimersByTimeAsync(9000);
    sound.press();
    expect(sound.voice.sending).toBe(true);
    sound.release();
    expect([asked.length, stopped]).toEqual([1, []]);
    await vi.advanceTimersByTimeAsync(10_000);
    expect(stopped).toEqual(['mic']);
    sound.press();
    expect(asked).toHaveLength(2);
  });

  it('says why there is none, and asks again at the next press', async () => {
    const { sound, asked, connect } = bench();
    connect();
    for (const [name, reason] of [
      ['NotAllowedError', 'refused'],
      ['NotFoundError', 'no-microphone'],
      ['NotReadableError', 'in-use'],
      ['OddError', 'failed'],
    ]) {
      sound.press();
      asked.at(-1)?.reject(new DOMException('why', name));
      await vi.advanceTimersByTimeAsync(0);
      expect(sound.voice).toMatchObject({ sending: false, failure: { reason } });
      sound.release();
    }
    expect(asked).toHaveLength(4);
  });

  it('ends with the session, and the microphone with it', async () => {
    const { sound, replaced, stopped, connect, grant, asked } = bench();
    connect();
    sound.press();
    await grant();
    sound.reset();
    expect(sound.voice).toEqual({ held: false, sending: false, failure: null });
    expect([replaced, stopped]).toEqual([['mic', null], ['mic']]);
    sound.press();
    expect([sound.voice.held, asked.length]).toEqual([false, 1]);
  });

  it('is not taken by a robot without a loudspeaker', () => {
    const { sound, asked, connect } = bench();
    connect();
    sound.latest = { type: 'sound', mid: '1', microphone: { state: 'off' } };
    sound.press();
    expect([sound.voice.held, asked.length]).toEqual([false, 0]);
  });
});

describe('the robot’s microphone', () => {
  it('is announced once for each line', () => {
    const { tracks, connect, sound } = bench();
    const track = { id: 'a' } as MediaStreamTrack;
    connect(track);
    connect(track);
    sound.reset();
    connect({ id: 'b' } as MediaStreamTrack);
    expect(tracks).toEqual(['a', 'b']);
  });

  it('is asked for and not', () => {
    const { sound, sent } = bench();
    sound.listen(true);
    sound.listen(false);
    expect(sent).toEqual([
      { type: 'listen', on: true },
      { type: 'listen', on: false },
    ]);
  });
});
