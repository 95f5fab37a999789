/** What is said about cameras, videos, the robot's sound and the operator's voice. */
import type { ItemDropReason, MicrophoneState, SourceState, VoiceFailureReason } from '@farpoint/operator';
import type { FrameDropReason } from '../../take/video/webcodecs/decode-gate.ts';

export const media = {
  camera: {
    hidden: 'hidden',
    noPicture: 'no picture',
    fault: (age: string) => `fault, ${age}`,
    waiting: 'waiting',
    frozen: (age: string) => `frozen, ${age}`,
  },
  /** Why a camera's video is not shown, if it is this browser that cannot. */
  cannotShow: {
    tooOld: 'This browser cannot show videos in step. Update it.',
    noCodec: 'This browser cannot decode this video.',
  },
  /** What the compositor did with the videos. */
  report: {
    states: { 'in-step': 'in step', apart: 'by itself', silent: 'silent' } satisfies Record<
      SourceState,
      string
    >,
    asItComes: 'as it comes',
    inVain: (times: string) => `waited for in vain ${times}`,
    drops: {
      superseded: 'replaced by a newer one',
      late: 'too late',
      overflow: 'too many waiting',
      removed: 'switched off',
    } satisfies Record<ItemDropReason, string>,
    notDecoded: 'Not decoded',
    undecoded: {
      'waits-for-key': 'waits for key',
      'out-of-order': 'out of order',
      'decoder-busy': 'decoder busy',
      'decoder-failed': 'decoder failed',
    } satisfies Record<FrameDropReason, string>,
    withoutTime: 'Without a time',
    notInStep: 'Not in step',
    noVideo: 'No video comes',
    oneVideo: 'One video',
    inStepWithin: (ms: number) => `In step within ${ms} ms`,
    cloud: 'Cloud',
  },
  heard: {
    off: 'Off',
    waitingForRobot: 'Waiting for the robot…',
    noSound: (why: string) => `No sound: ${why}`,
    microphoneFailed: 'the microphone has failed',
    microphone: {
      off: 'Waiting for the robot…',
      starting: 'The microphone starts…',
      muted: 'Muted while you speak',
      'slow-link': 'Off: the connection is too slow for sound',
    } satisfies Record<Exclude<MicrophoneState, 'live' | 'failed'>, string>,
    refused: 'The browser did not play it: press Sound twice',
    waitingForSound: 'Waiting for sound…',
    live: 'Live',
  },
  /** Why the operator's microphone cannot be used. */
  voiceFailures: {
    refused: 'The browser does not let this page use the microphone. Allow it in the address bar to speak.',
    'no-microphone': 'No microphone was found. Connect one to speak.',
    'in-use': 'The microphone is in use by another program.',
    insecure: 'To speak, open the page at its https address.',
    failed: 'The microphone could not be opened.',
  } satisfies Record<VoiceFailureReason, string>,
  voice: {
    opening: 'Opening your microphone…',
    heard: 'The robot hears you',
    onlyDriver: 'Not heard: only the driver can speak',
    failed: (why: string) => `Not heard: ${why}`,
    loudspeakerFailed: 'the loudspeaker has failed',
    silent: 'Not heard: your voice does not arrive',
    waiting: 'Waiting for the robot…',
  },
  sound: 'Sound',
  soundTitle: 'Hear the robot’s microphone',
  volume: 'Volume',
};
