/** Explains why the robot could not start, in the doctor's words. */
import { GrantKeysError } from '@farpoint/grants';
import { RecordingError } from '@farpoint/recording';
import { RosFault } from '@farpoint/ros';
import { StartFailure } from '@farpoint/service';
import { FileInUseError, SharedMemoryError } from '@farpoint/shared-memory';
import { RevocationJournalError } from '../../admit/access/revocation-journal.ts';
import { CaptureError } from '../../sense/capture/capture.ts';
import type { RobotOptions } from '../robot-configuration.ts';
import { checkRecording, checkSharedMemory } from './check-files.ts';
import { judgeClosedSource } from './check-source.ts';
import type { Result } from './finding.ts';

/**
 * @param error thrown by the robot's start
 * @returns a StartFailure that says what to do, or `error` itself if the doctor has no explanation
 */
export function startFailure({ sensors, sink, record }: RobotOptions, error: unknown): unknown {
  const sources = sensors.map(({ capture }) => capture.source);
  if (error instanceof CaptureError) {
    const source = sources[error.sensor];
    return source === undefined ? error : failure(error, judgeClosedSource(source, error));
  }
  if (error instanceof RecordingError)
    return failure(error, checkRecording(record), 'set recording.file (--record) to another file');
  // The files themselves are well.
  if (error instanceof FileInUseError) return new StartFailure(error.fault, error.remedy, { cause: error });
  if (error instanceof SharedMemoryError)
    return failure(
      error,
      sources.flatMap((source) => checkSharedMemory(source, sink)),
      'docs/shared-memory.md describes the layouts',
    );
  if (error instanceof GrantKeysError)
    return new StartFailure(
      `access.grantKeys: ${error.message}`,
      'write it with `farpoint-signaling grant keygen`',
      {
        cause: error,
      },
    );
  if (error instanceof RevocationJournalError)
    return new StartFailure(
      `the robot cannot tell which grants were revoked: ${error.message}`,
      'restore the file, or delete it if the lists that are sent again say enough',
      { cause: error },
    );
  if (error instanceof RosFault)
    return new StartFailure(error.what, error.remedy ?? 'docs/ros.md lists what is needed', { cause: error });
  return error;
}

/** Uses the first failed result, or the original error if every check passes by now. */
function failure(error: Error, results: readonly Result[], otherwise = ''): StartFailure {
  const found = results.find(({ verdict }) => verdict === 'fail');
  return new StartFailure(found?.detail ?? error.message, found?.remedy ?? otherwise, { cause: error });
}
