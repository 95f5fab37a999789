import type { Logger } from '@farpoint/service';
import { availableEncoders, chooseEncoders, VideoError, type VideoSource } from '@farpoint/video';
import { CodecEncoders } from '../../sense/video/codec-encoders.ts';
import { type FeedSource, isFeedSource } from '../../sense/video/feed/feed-source.ts';
import { FeedThread } from '../../sense/video/feed/feed-thread.ts';
import { ProcessEncoder } from '../../sense/video/process-encoder.ts';
import type { VideoCamera } from '../../sense/video/video-encoder.ts';

/** A camera that is streamed as video. */
export interface VideoCameraOptions {
  name: string;
  source: VideoSource | FeedSource;
  /** `auto`, or the name of one. */
  encoder: string;
  /** At most, pixels. */
  width: number;
  height: number;
  /** At most. */
  framesPerS: number;
  kbitPerS: number;
  /** It is the depth camera's own colour picture: the clouds' lens, place and capture instants. */
  ofCloud: boolean;
}

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
      const chosen = chooseEncoders(encoders, camera.encoder);
      if (chosen.ok) {
        const own = new CodecEncoders(chosen.encoders);
        log.info({ camera: camera.name, encoder: own.names }, 'camera with video');
        return [videoCamera(camera, own, thread, log)];
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

function videoCamera(
  camera: VideoCameraOptions,
  encoders: CodecEncoders,
  thread: FeedThread,
  log: Logger,
): VideoCamera {
  const { name, source, width, height, framesPerS, kbitPerS, ofCloud } = camera;
  const most = { width, height, framesPerSecond: framesPerS, bitsPerSecond: kbitPerS * 1000 };
  const { codecs } = encoders;
  const ofSensor = ofCloud ? { ofSensor: 0 } : {};
  if (isFeedSource(source)) {
    return {
      name,
      codecs,
      most,
      ...ofSensor,
      open: (codec, format, events) =>
        thread.open({ name, source, encoder: encoders.of(codec) }, format, events),
    };
  }
  const child = log.child({ camera: name });
  return {
    name,
    codecs,
    most,
    ...ofSensor,
    open: (codec, format, events) =>
      new ProcessEncoder({ source, encoder: encoders.of(codec) }, format, events, child),
  };
}
