export { CloudPlayer, type PlayedCloud } from './cloud-player.ts';
export { CloudTap, type TapGrid, type TappedCloud, type TappedPackets } from './cloud-tap.ts';
export { RecordingError, type RecordingErrorCode } from './errors.ts';
export { openRecording } from './open-recording.ts';
export type { PlayOptions } from './play-options.ts';
export type { PlayClock } from './play-timeline.ts';
export {
  ALARM_TYPES,
  alarmRecordSchema,
  quantityOf,
  SAMPLE_TYPES,
  sampleRecordSchema,
  sincesOf,
} from './recorded-telemetry.ts';
export type {
  CloudKind,
  DropKind,
  LiveReport,
  RecordedAlarm,
  RecordedQuantity,
  RecordedVideo,
  RecorderOptions,
  VideoFormatName,
} from './recorder-messages.ts';
export type { RecordedMessage, RecordedTopic, Recording } from './recording.ts';
export { SessionRecorder } from './session-recorder.ts';
