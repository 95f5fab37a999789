export { BUILD_REMEDY } from './build.ts';
export { Loudspeaker, type LoudspeakerOptions } from './loudspeaker.ts';
export {
  LEAST_SOUND_BITS_PER_S,
  Microphone,
  type MicrophoneOptions,
  MOST_SOUND_BITS_PER_S,
} from './microphone.ts';
export { opusDurationMs } from './opus-packet.ts';
export {
  type SoundSink,
  type SoundSinkOptions,
  type SoundSource,
  type SoundSourceOptions,
  soundSinkSchema,
  soundSourceSchema,
} from './sound-device.ts';
export type { SoundFailure, SoundFailureReason } from './sound-failure.ts';
export { type PlayedVoice, VoiceBuffer, type VoiceDrop } from './voice-buffer.ts';
export type { SoundPacket } from './wire.ts';
