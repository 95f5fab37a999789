/** Times the video encoders of this machine. */
import {
  type AvailableEncoder,
  availableEncoders,
  chooseEncoder,
  VideoError,
  type VideoFailure,
  VideoProcess,
} from '@farpoint/video';
import { type TimedEncoder, TRIAL } from './check-video.ts';

const PICTURES = 15;
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
