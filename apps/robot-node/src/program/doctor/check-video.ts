/** Checks which video encoders there are, what they cost, and whether the configured cameras can be encoded. */
import { type AvailableEncoder, chooseEncoder, VIDEO_ENCODERS, type VideoFailure } from '@farpoint/video';
import type { VideoCameraOptions } from '../../serve/cameras/open-video-cameras.ts';
import { fail, ok, type Result, warn } from './finding.ts';

export interface TimedEncoder extends AvailableEncoder {
  /** Median time to encode one picture, ms; `null` if the encoder gave none. */
  encodeMs: number | null;
}

/** The picture with which encoders are timed. */
export const TRIAL = { width: 1024, height: 768, framesPerS: 30, bitsPerS: 1_500_000 } as const;
/** Half of the time between two pictures: a second camera and everything else need the rest. */
const SLOW_MS = 500 / TRIAL.framesPerS;

/** @param found the encoders that work here, timed; or why video is not possible at all */
export function judgeVideo(
  found: readonly TimedEncoder[] | VideoFailure,
  cameras: readonly Pick<VideoCameraOptions, 'name' | 'encoder'>[],
): Result[] {
  if (!('length' in found)) {
    if (cameras.length > 0) return [fail(`no video: ${found.sentence}`, found.remedy)];
    return [ok('camera video is not built: cameras are shown as a few JPEG pictures a second')];
  }
  return [
    ...found.map(judgeEncoder),
    ...cameras.map(({ name, encoder }) => {
      const chosen = chooseEncoder(found, encoder);
      if (!chosen.ok) return fail(`${name}: ${chosen.failure.sentence}`, chosen.failure.remedy);
      return ok(`${name} is encoded by ${chosen.encoder.name}`);
    }),
  ];
}

function judgeEncoder({ name, codec, encodeMs }: TimedEncoder): Result {
  const runsOn = VIDEO_ENCODERS.find((each) => each.name === name)?.runsOn ?? 'CPU';
  const what = `${name} (${codec === 'h264' ? 'H.264' : 'VP8'}, ${runsOn})`;
  if (encodeMs === null) return warn(`${what} gives no pictures`, 'check its driver, or use another encoder');
  const { width, height } = TRIAL;
  const cost = `${what}: ${encodeMs.toFixed(1)} ms for a picture of ${width} × ${height}`;
  if (encodeMs <= SLOW_MS) return ok(cost);
  return warn(cost, 'use smaller pictures, fewer a second, or another encoder');
}
