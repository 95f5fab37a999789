import type { Logger } from '@farpoint/service';
import { availableEncoders, chooseEncoder, VideoError } from '@farpoint/video';
import type { VideoCameraOptions } from '../robot-configuration.ts';
import { isFeedSource } from './feed/feed-source.ts';
import { FeedThread } from './feed/feed-thread.ts';
import { ProcessEncoder } from './process-encoder.ts';
import type { VideoCamera } from './video-encoder.ts';

/**
 * The cameras that can be streamed as video. A robot drives without them, so one that cannot be encoded is left out, and
 * the log says why.
 */
export async function openVideoCameras(
  cameras: readonly VideoCameraOptions[],
  log: Logger,
): Promise<VideoCamera[]> {
  if (cameras.length === 0) return [];
  try {
    const { encoders } = await availableEncoders();
    const thread = new FeedThread(log);
    return cameras.flatMap((camera) => {
      const chosen = chooseEncoder(encoders, camera.encoder);
      if (chosen.ok) {
        log.info({ camera: camera.name, encoder: chosen.encoder.name }, 'camera with video');
        return [videoCamera(camera, chosen.encoder, thread, log)];
      }
      const { sentence, remedy } = chosen.failure;
      log.warn({ camera: camera.name, remedy }, `no video: ${sentence}`);
      return [];
    });
  } catch (error) {
    if (!(error instanceof VideoError)) throw error;
    const { sentence, remedy } = error.failure;
    log.warn({ cameras: cameras.map(({ name }) => name), remedy }, `no video: ${sentence}`);
    return [];
  }
}

export type ChosenEncoder = Extract<ReturnType<typeof chooseEncoder>, { ok: true }>['encoder'];

function videoCamera(
  camera: VideoCameraOptions,
  encoder: ChosenEncoder,
  thread: FeedThread,
  log: Logger,
): VideoCamera {
  const { name, source, width, height, framesPerS, kbitPerS } = camera;
  const most = { width, height, framesPerSecond: framesPerS, bitsPerSecond: kbitPerS * 1000 };
  const codec = encoder.codec === 'h264' ? 'H264' : 'VP8';
  if (isFeedSource(source)) {
    const fed = { name, source, encoder };
    return { name, codec, most, open: (format, events) => thread.open(fed, format, events) };
  }
  const child = log.child({ camera: name });
  return {
    ...{ name, codec, most },
    open: (format, events) => new ProcessEncoder({ source, encoder }, format, events, child),
  };
}
