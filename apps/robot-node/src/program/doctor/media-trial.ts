/** Times the video encoders of this machine. */

import { LEAST_SOUND_BITS_PER_S, Loudspeaker, Microphone, type SoundFailure } from '@farpoint/sound';
import {
  type AvailableEncoder,
  availableEncoders,
  chooseEncoder,
  VideoError,
  type VideoFailure,
  VideoProcess,
} from '@farpoint/video';
import type { SoundOptions } from '../../sense/sound/open-sound-devices.ts';
import type { SoundTrial } from './check-sound.ts';
import { type TimedEncoder, TRIAL } from './check-video.ts';

/**
 * The longest wait for a device's first sound, ms: a second more than the silence after which its process
 * calls it lost (packages/sound).
 */
const LONGEST_SOUND_MS = 6000;

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
  const timer = setTimeout(() => done.resolve({ device, fault: null, startedMs: null }), LONGEST_SOUND_MS);
  const trial = await done.promise;
  clearTimeout(timer);
  await opened.close();
  return trial;
}

/** Pictures that are timed. Chosen: half of a second at 30 a second, after the key frame. */
const PICTURES = 15;
/** The longest wait for them, ms. Chosen: an encoder that takes longer is far too slow for any camera. */
const LONGEST_MS = 4000;

/** @returns all encoders that are there, timed one after another; or why there are none */
export async function timeEncoders(): Promise<TimedEncoder[] | VideoFailure> {
  try {
    const { encoders } = await availableEncoders();
    const timed: TimedEncoder[] = [];
    for (const encoder of encoders) timed.push({ ...encoder, encodeMs: await timeEncoder(encoder) });
    return timed;
  } catch (error) {
    if (error instanceof VideoError) return error.failure;
    throw error;
  }
}

async function timeEncoder(available: AvailableEncoder): Promise<number | null> {
  const chosen = chooseEncoder([available], available.name);
  if (!chosen.ok) return null;
  const { width, height, framesPerS, bitsPerS } = TRIAL;
  const times: number[] = [];
  const done = Promise.withResolvers<void>();
  const video = new VideoProcess({
    source: { kind: 'test', width, height, framesPerS },
    encoder: chosen.encoder,
    settings: { bitsPerS },
    onFrame: ({ key, encodeMs }) => {
      // The first picture takes longer than any that follows.
      if (!key) times.push(encodeMs);
      if (times.length === PICTURES) done.resolve();
    },
    onFailure: () => done.resolve(),
  });
  const timer = setTimeout(done.resolve, LONGEST_MS);
  await done.promise;
  clearTimeout(timer);
  await video.close();
  return times.toSorted((a, b) => a - b)[times.length >> 1] ?? null;
}
