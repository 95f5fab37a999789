/** Asks GStreamer which encoders this machine has. */
import { execFile } from 'node:child_process';
import { promisify } from 'node:util';
import { ADDON_FILE } from './build.ts';
import { type EncoderList, parseEncoders } from './process-messages.ts';
import { VideoError, videoFailure } from './video-failure.ts';

const execute = promisify(execFile);
/**
 * The first start after an installation looks at each plugin, ms. Chosen: on a small board with a slow card
 * that takes tens of seconds.
 */
const MOST_MS = 60_000;

/** @throws {VideoError} `not-built` if the program is missing or cannot be run */
export async function availableEncoders(program = ADDON_FILE): Promise<EncoderList> {
  try {
    const { stdout } = await execute(program, ['--list-encoders'], { encoding: 'buffer', timeout: MOST_MS });
    return parseEncoders(stdout);
  } catch (cause) {
    throw new VideoError(videoFailure('not-built', cause instanceof Error ? cause.message : String(cause)), {
      cause,
    });
  }
}
