/** Why no video comes, what to do about it, and whether trying again can help. */
import { withoutPasswords } from '@farpoint/media-process';
import { BUILD_REMEDY } from './build.ts';

export { withoutPasswords } from '@farpoint/media-process';

export const VIDEO_FAILURE_REASONS = [
  'not-built', // the program farpoint-video is missing, or cannot be run
  'parse', // the source's text is no pipeline
  'no-element', // the source needs an element that is not installed
  'no-encoder', // there is no encoder of this name, or for this codec
  'source-lost', // the source has ended, sends nothing, or reports an error
  'not-negotiated', // the source's pictures have a format that the encoder cannot be given
  'encoder-failed', // the encoder reports an error
  'process-lost', // the process ended without a word: it crashed or was killed
  'process-hung', // the process said nothing for too long, and was killed
  'bad-output', // the process sent what makes no sense
] as const;
export type VideoFailureReason = (typeof VIDEO_FAILURE_REASONS)[number];

export interface VideoFailure {
  readonly reason: VideoFailureReason;
  /** What is wrong, in one sentence, with GStreamer's own words. */
  readonly sentence: string;
  readonly remedy: string;
  /** Whether it is tried again by itself. */
  readonly retried: boolean;
}

const PLUGINS =
  'gstreamer1.0-plugins-base gstreamer1.0-plugins-good gstreamer1.0-plugins-ugly gstreamer1.0-plugins-bad';

const ABOUT: Record<VideoFailureReason, { what: string; remedy: string; retried: boolean }> = {
  'not-built': { what: 'the video program cannot be started', remedy: BUILD_REMEDY, retried: false },
  parse: {
    what: 'the source is no valid pipeline',
    remedy: 'correct its text; `gst-launch-1.0 -v PIPELINE ! fakesink` tries it alone',
    retried: false,
  },
  'no-element': {
    what: 'the source needs a GStreamer element that is not installed',
    remedy: `install the plugin that has it (Debian: \`apt-get install ${PLUGINS}\`)`,
    retried: false,
  },
  'no-encoder': {
    what: 'the encoder is not installed',
    remedy: `install its plugin (Debian: \`apt-get install ${PLUGINS}\`), or choose another encoder`,
    retried: false,
  },
  'source-lost': {
    what: 'the source gives no pictures',
    remedy: 'check that the camera is connected, and that no other program uses it',
    retried: true,
  },
  'not-negotiated': {
    what: 'the source and the encoder have no picture format in common',
    remedy: 'choose a size, a rate and a format that the camera has (`v4l2-ctl --list-formats-ext`)',
    retried: false,
  },
  'encoder-failed': {
    what: 'the encoder failed',
    remedy: 'check its driver, or choose an encoder in software (x264enc, vp8enc)',
    retried: true,
  },
  'process-lost': {
    what: 'the video process ended unexpectedly',
    remedy: 'if this repeats, choose another encoder: a plugin crashes',
    retried: true,
  },
  'process-hung': {
    what: 'the video process hung',
    remedy: 'if this repeats, choose another encoder: a plugin or a driver hangs',
    retried: true,
  },
  'bad-output': {
    what: 'the video process sent bytes that make no sense',
    remedy: 'build it again: `pnpm build:native video`',
    retried: true,
  },
};

/** @param said GStreamer's own words, or the system's */
export function videoFailure(reason: VideoFailureReason, said: string): VideoFailure {
  const { what, remedy, retried } = ABOUT[reason];
  return { reason, sentence: `${what}: ${withoutPasswords(said)}`, remedy, retried };
}

/** Thrown where there is no video to begin with. */
export class VideoError extends Error {
  override readonly name = 'VideoError';
  readonly failure: VideoFailure;

  constructor(failure: VideoFailure, options?: ErrorOptions) {
    super(`${failure.sentence}; ${failure.remedy}`, options);
    this.failure = failure;
  }
}
