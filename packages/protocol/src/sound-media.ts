/** The m-line of the robot's microphone and the operator's voice: an ordinary one, which any WebRTC client can hear. */

/** Opus (RFC 7587), in both directions. */
export const SOUND_MEDIA = { kind: 'audio', mimeType: 'audio/opus', clockRate: 48_000, channels: 2 } as const;

/** What either side asks the other to send: packets of at least 10 ms, with forward error correction. */
export const SOUND_PARAMETERS = 'minptime=10;useinbandfec=1';

/** The `MediaStream` of the robot's microphone. */
export const SOUND_STREAM_ID = 'farpoint-sound';

/** What an operator gets of the robot's microphone. */
export const MICROPHONE_STATES = [
  'off', // the operator does not listen
  'starting', // it listens, and nothing has been captured yet
  'live', // sound is sent to the operator
  'muted', // not while the operator's own voice is played: it would hear itself
  'slow-link', // the path has no room for sound
  'failed', // nothing can be captured
] as const;
/** What an operator gets of the robot's microphone. */
export type MicrophoneState = (typeof MICROPHONE_STATES)[number];

/** What the robot does with an operator's voice. */
export const VOICE_STATES = [
  'closed', // it is not played
  'open', // it is played: the robot hears the operator
  'not-driving', // the operator speaks, but does not drive
  'silent', // the operator speaks, but no packets arrive
  'failed', // the loudspeaker cannot be used
] as const;
/** What the robot does with an operator's voice. */
export type VoiceState = (typeof VOICE_STATES)[number];

/** While it speaks, an operator repeats that so often at least, ms. */
export const SPEAK_REPEAT_MS = 250;
