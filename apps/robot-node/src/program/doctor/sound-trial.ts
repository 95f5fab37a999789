/** Tries the robot's microphone and loudspeaker. */
import { LEAST_SOUND_BITS_PER_S, Loudspeaker, Microphone, type SoundFailure } from '@farpoint/sound';
import type { SoundOptions } from '../../sense/sound/open-sound-devices.ts';
import type { SoundTrial } from './check-sound.ts';

const LONGEST_MS = 6000;

/** Opens each device that is configured, waits until it works or says why not, and closes it. */
export async function trySound({ microphone, loudspeaker }: SoundOptions): Promise<SoundTrial[]> {
  const trials: SoundTrial[] = [];
  if (microphone !== undefined) {
    const { source } = microphone;
    const open = (onWorks: () => void, onFailure: (failure: SoundFailure) => void) =>
      new Microphone({ source, bitsPerS: LEAST_SOUND_BITS_PER_S, onPacket: onWorks, onFailure });
    trials.push(await tryDevice('microphone', open));
  }
  if (loudspeaker !== undefined) {
    const { sink } = loudspeaker;
    const open = (onWorks: () => void, onFailure: (failure: SoundFailure) => void) =>
      new Loudspeaker({ sink, onStarted: onWorks, onFailure });
    trials.push(await tryDevice('loudspeaker', open));
  }
  return trials;
}

async function tryDevice(
  device: SoundTrial['device'],
  open: (onWorks: () => void, onFailure: (failure: SoundFailure) => void) => { close(): Promise<void> },
): Promise<SoundTrial> {
  const began = performance.now();
  const done = Promise.withResolvers<SoundTrial>();
  const opened = open(
    () => done.resolve({ device, fault: null, startedMs: performance.now() - began }),
    (fault) => done.resolve({ device, fault, startedMs: null }),
  );
  const timer = setTimeout(() => done.resolve({ device, fault: null, startedMs: null }), LONGEST_MS);
  const trial = await done.promise;
  clearTimeout(timer);
  await opened.close();
  return trial;
}
