export { CloudPlayer, type PlayClock, type PlayedCloud, type PlayOptions } from './cloud-player.ts';
export { RecordingError, type RecordingErrorCode } from './errors.ts';
export { openRecording } from './open-recording.ts';
export type { CloudAxes } from './point-cloud2.ts';
export type { RecordedMessage, RecordedTopic, Recording } from './recording.ts';
