/** Why there is no sound, what to do about it, and whether trying again can help. */
import { withoutPasswords } from '@farpoint/media-process';
import { BUILD_REMEDY } from './build.ts';

export const SOUND_FAILURE_REASONS = [
  'not-built', // the program farpoint-sound is missing, or cannot be run
  'parse', // the text of the source or the sink is no pipeline
  'no-element', // an element is not installed
  'device-lost', // the device is missing, in use or unplugged, has ended, or gives nothing
  'not-negotiated', // the device has no format that can be used
  'codec-failed', // the encoder reports an error
  'process-lost', // the process ended without a word: it crashed or was killed
  'process-hung', // the process said nothing for too long, and was killed
  'bad-output', // the process sent what makes no sense
] as const;
export type SoundFailureReason = (typeof SOUND_FAILURE_REASONS)[number];

/** What a process serves. */
export type SoundRole = 'microphone' | 'loudspeaker';

export interface SoundFailure {
  readonly reason: SoundFailureReason;
  /** What is wrong, in one sentence, with GStreamer's own words. */
  readonly sentence: string;
  readonly remedy: string;
  /** Whether it is tried again by itself. */
  readonly retried: boolean;
}

const PLUGINS = 'gstreamer1.0-plugins-base gstreamer1.0-plugins-good gstreamer1.0-alsa gstreamer1.0-pipewire';

const ABOUT: Record<
  SoundFailureReason,
  { what: (role: SoundRole) => string; remedy: string; retried: boolean }
> = {
  'not-built': {
    what: () => 'the sound program cannot be started',
    remedy: BUILD_REMEDY,
    retried: false,
  },
  parse: {
    what: (role) => `the ${role} is no valid pipeline`,
    remedy: 'correct its text; `gst-launch-1.0 -v` tries it alone',
    retried: false,
  },
  'no-element': {
    what: (role) => `the ${role} needs a GStreamer element that is not installed`,
    remedy: `install the plugin that has it (Debian: \`apt-get install ${PLUGINS}\`)`,
    retried: false,
  },
  'device-lost': {
    what: (role) => `the ${role} does not work`,
    remedy:
      'check that the device is connected, and that no other program uses it (`arecord -l`, `aplay -l`)',
    retried: true,
  },
  'not-negotiated': {
    what: (role) => `the ${role} has no format that can be used`,
    remedy: 'choose another device, for ALSA one that converts, such as `default` or `plughw:0`',
    retried: false,
  },
  'codec-failed': {
    what: () => 'the Opus encoder failed',
    remedy: 'check the installation of gstreamer1.0-plugins-base',
    retried: true,
  },
  'process-lost': {
    what: () => 'the sound process ended unexpectedly',
    remedy: 'if this repeats, choose another kind of device: a plugin crashes',
    retried: true,
  },
  'process-hung': {
    what: () => 'the sound process hung',
    remedy: 'if this repeats, choose another kind of device: a plugin or a driver hangs',
    retried: true,
  },
  'bad-output': {
    what: () => 'the sound process sent bytes that make no sense',
    remedy: 'build it again: `pnpm build:native sound`',
    retried: true,
  },
};

/** @param said GStreamer's own words, or the system's */
export function soundFailure(role: SoundRole, reason: SoundFailureReason, said: string): SoundFailure {
  const { what, remedy, retried } = ABOUT[reason];
  return { reason, sentence: `${what(role)}: ${withoutPasswords(said)}`, remedy, retried };
}
