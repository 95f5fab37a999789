export { availableEncoders } from './available-encoders.ts';
export {
  type AvailableEncoder,
  type ChosenEncoder,
  type ChosenEncoders,
  chooseEncoder,
  chooseEncoders,
  VIDEO_ENCODERS,
  type VideoCodec,
  type VideoEncoder,
  WANTED_ENCODERS,
} from './encoders.ts';
export type { EncoderList, LogLine, VideoPlaying, VideoState, VideoStats } from './process-messages.ts';
export { VideoError, type VideoFailure, type VideoFailureReason } from './video-failure.ts';
export { VideoProcess, type VideoProcessOptions } from './video-process.ts';
export { type VideoSettings, videoSettingsSchema } from './video-settings.ts';
export {
  TEST_PATTERNS,
  type VideoSource,
  type VideoSourceOptions,
  videoSourceSchema,
} from './video-source.ts';
export {
  CODINGS,
  type CodedPicture,
  type Coding,
  type EncodedFrame,
  RAW_FORMATS,
  type RawFormat,
  type RawFrame,
  rawFrameBytes,
} from './wire.ts';
