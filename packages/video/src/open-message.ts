/** The first message to the process: what it is to encode, and by what. */
import { availableParallelism } from 'node:os';
import {
  encoderText,
  encoderThreads,
  type FollowingProperty,
  neededElements,
  type VideoEncoder,
} from './encoders.ts';
import { silenceMs, sourceText, type VideoSource } from './video-source.ts';
import { writeOpen } from './wire.ts';

/**
 * Test sources begin at a multiple of this, so that those with equal rates capture at the same instants, as cameras with
 * a common trigger do. The intervals of all whole rates divide it.
 */
const TEST_PHASE_MS = 1000;

/** @param extra further properties of the encoder */
export function openMessage(
  source: VideoSource,
  encoder: VideoEncoder,
  extra: string,
  silence = silenceMs(source),
): Uint8Array {
  return writeOpen([
    ['source', sourceText(source)],
    ['encoder', encoderText(encoder, encoderThreads(availableParallelism()), extra)],
    ['name', encoder.name],
    ['codec', encoder.codec],
    ['raw', encoder.raw],
    ['silence-ms', String(silence)],
    ...(source.kind === 'test' ? [['phase-ms', String(TEST_PHASE_MS)] as const] : []),
    ...neededElements(encoder).map((name) => ['element', name] as const),
    ...encoder.following.map((each) => ['property', followingText(each)] as const),
  ]);
}

function followingText({
  name,
  perBitPerS = 0,
  perInterval = 0,
  perFrameBit = 0,
}: FollowingProperty): string {
  return [name, perBitPerS, perInterval, perFrameBit].join(':');
}
