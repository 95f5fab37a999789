import type { Logger } from '@farpoint/service';
import {
  availableEncoders,
  chooseEncoder,
  VideoError,
  VideoProcess,
  type VideoSource,
} from '@farpoint/video';
import type { VideoCameraOptions } from '../options/videos.ts';
import type { VideoCamera, VideoEncoder, VideoEncoderEvents } from './video-encoder.ts';
import type { EncodedFormat } from './video-plan.ts';

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
    return cameras.flatMap((camera) => {
      const chosen = chooseEncoder(encoders, camera.encoder);
      if (chosen.ok) {
        log.info({ camera: camera.name, encoder: chosen.encoder.name }, 'camera with video');
        return [videoCamera(camera, chosen.encoder, log)];
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

function videoCamera(camera: VideoCameraOptions, encoder: ChosenEncoder, log: Logger): VideoCamera {
  const { name, source, width, height, framesPerS, kbitPerS } = camera;
  return {
    name,
    codec: encoder.codec === 'h264' ? 'H264' : 'VP8',
    most: { width, height, framesPerSecond: framesPerS, bitsPerSecond: kbitPerS * 1000 },
    open: (format, events) => openEncoder({ source, encoder }, format, events, log.child({ camera: name })),
  };
}

/** A camera's encoder, with the process that runs it. */
export function openEncoder(
  { source, encoder }: { source: VideoSource; encoder: ChosenEncoder },
  format: EncodedFormat,
  events: VideoEncoderEvents,
  log: Logger,
): VideoEncoder & { readonly process: VideoProcess } {
  let dropped = 0;
  /** Of earlier processes: each counts from 0. */
  let droppedBefore = 0;
  const process = new VideoProcess({
    ...{ source, encoder, settings: settingsOf(format) },
    onFrame: ({ bytes, key, captureMs: capturedAtMs, width, height }) => {
      events.onFault(null);
      events.onPicture({ bytes, key, capturedAtMs, width, height });
    },
    onState: (state) => {
      if (state.state === 'playing') log.info({ video: state }, 'video plays');
      else dropped = state.dropped;
    },
    onFailure: ({ sentence, remedy, retried, reason }) => {
      log.debug({ reason, retried, remedy }, sentence);
      droppedBefore += dropped;
      dropped = 0;
      events.onFault(`${sentence}; ${remedy}`);
    },
    onLog: ({ level, msg }) => log[level]({ from: 'farpoint-video' }, msg),
  });
  return {
    process,
    configure: (next) => process.configure(settingsOf(next)),
    requestKeyFrame: () => process.requestKeyFrame(),
    get dropped() {
      return droppedBefore + dropped;
    },
    close: () => process.close(),
  };
}

function settingsOf({ width, height, framesPerSecond, bitsPerSecond, barcode }: EncodedFormat) {
  return {
    ...{ bitsPerS: bitsPerSecond, framesPerS: framesPerSecond, width, height },
    barcode: barcode ? ('monotonic' as const) : undefined,
  };
}
