/** Where sessions go besides their operators. */
import type { LiveOptions, RecordingOptions } from '../telemetry/session-outputs.ts';
import type { RobotOptionValues } from './robot-program.ts';

/** @returns undefined if nothing is recorded, and nobody may record */
export function toRecording(values: RobotOptionValues): RecordingOptions | undefined {
  const { record: path, recordFolder: folder, recordClouds, recordFolderMax: mostBytes } = values;
  if (path === null && folder === null) return undefined;
  const takes = (kind: 'captured' | 'sent') => recordClouds === kind || recordClouds === 'both';
  return {
    path,
    folder: folder === null ? null : { path: folder, mostBytes },
    compression: values.recordCompression,
    clouds: {
      captured: takes('captured') ? values.recordCapturedFps : 0,
      sent: takes('sent') ? values.recordSentFps : 0,
    },
    videos: values.recordVideos,
    mostBytes: values.recordMax,
  };
}

/** @returns undefined if there is no server for live viewers */
export function toLive(values: RobotOptionValues): LiveOptions | undefined {
  const { foxglovePort: port, foxgloveReach: reach, foxgloveOrigins, foxgloveFps } = values;
  if (port === null) return undefined;
  return { port, reach, allowedOrigins: foxgloveOrigins, cloudsPerSecond: foxgloveFps };
}
