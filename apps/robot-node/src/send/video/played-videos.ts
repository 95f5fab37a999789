import type { PlayedPicture } from '@farpoint/cloud-source';
import { MAX_VIDEOS } from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import { nsOfMs } from '@farpoint/timing';
import { availableEncoders, chooseEncoders, VideoError } from '@farpoint/video';
import { monotonicMs } from '../../ground/clock.ts';
import type { Capture } from '../../sense/capture/capture.ts';
import { CodecEncoders } from '../../sense/video/codec-encoders.ts';
import { ProcessEncoder } from '../../sense/video/process-encoder.ts';
import type { VideoCamera } from '../../sense/video/video-encoder.ts';

/** A played video is never enlarged: one that is smaller keeps its size. */
const MOST = { width: 1024, height: 768, framesPerSecond: 30 };

export interface PlayedVideosOptions {
  /** Maximum rate of each. */
  bitsPerSecond: number;
  /** The robot's other cameras. */
  besides: readonly Pick<VideoCamera, 'name'>[];
}

/**
 * The videos of the recording that a source plays, as cameras: their pictures are decoded and encoded again, so that they
 * fit each operator's link.
 */
export async function openPlayedVideos(
  capture: Pick<Capture, 'description' | 'onVideo' | 'watchVideo'>,
  { bitsPerSecond, besides }: PlayedVideosOptions,
  log: Logger,
): Promise<VideoCamera[]> {
  const taken = new Set(besides.map(({ name }) => name));
  const names = (capture.description.videos ?? []).slice(0, MAX_VIDEOS - taken.size);
  if (names.length === 0) return [];
  const encoders = await encodersFor(names, log);
  if (encoders === null) return [];
  const takers = new Map<number, (picture: PlayedPicture) => void>();
  capture.onVideo = (video, picture) => takers.get(video)?.(picture);
  return names.map((recorded, video) => {
    const name = taken.has(recorded) ? `${recorded.slice(0, 50)} (recorded)` : recorded;
    log.info({ camera: name, encoder: encoders.names }, 'video from the recording');
    const camera: VideoCamera = {
      name,
      codecs: encoders.codecs,
      most: { ...MOST, bitsPerSecond },
      open: (codec, format, events) => {
        const run = { source: { kind: 'frames' as const }, encoder: encoders.of(codec) };
        const opened = new ProcessEncoder(run, format, events, log.child({ camera: name }));
        const openedMs = monotonicMs();
        let isLive = false;
        const take = ({ coding, bytes, capturedAtMs }: PlayedPicture) => {
          const captureNs = nsOfMs(capturedAtMs);
          if (!isLive && capturedAtMs > openedMs) {
            isLive = true;
            // What led up to it is older than what some may have seen before.
            opened.requestKeyFrame();
          }
          if (bytes.length > 0) opened.process.pushCoded({ captureNs, coding, bytes });
        };
        takers.set(video, take);
        capture.watchVideo(video, true);
        return {
          configure: (next) => opened.configure(next),
          requestKeyFrame: () => opened.requestKeyFrame(),
          get dropped() {
            return opened.dropped;
          },
          close: () => {
            // It may have been opened again before.
            if (takers.get(video) === take) {
              takers.delete(video);
              capture.watchVideo(video, false);
            }
            return opened.close();
          },
        };
      },
    };
    return camera;
  });
}

/** A robot drives without videos: the log says why it has none. */
async function encodersFor(cameras: readonly string[], log: Logger): Promise<CodecEncoders | null> {
  const none = (sentence: string, remedy: string) => {
    log.warn({ cameras, remedy }, `no video from the recording: ${sentence}`);
    return null;
  };
  try {
    const { encoders } = await availableEncoders();
    const chosen = chooseEncoders(encoders, 'auto');
    return chosen.ok
      ? new CodecEncoders(chosen.encoders)
      : none(chosen.failure.sentence, chosen.failure.remedy);
  } catch (error) {
    if (!(error instanceof VideoError)) throw error;
    return none(error.failure.sentence, error.failure.remedy);
  }
}
