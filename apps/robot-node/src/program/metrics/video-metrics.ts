import type { PulledMetrics } from '@farpoint/service';
import type { VideoStream } from '../../sense/video/video-stream.ts';
import type { MeasuredRobot } from './measured-robot.ts';

/** Metrics of the cameras that are streamed as video. None if the robot has no such camera. */
export function addVideoMetrics(
  metrics: PulledMetrics,
  { streams: { cameras }, operators }: MeasuredRobot,
): void {
  const { streams } = cameras.videos;
  if (streams.length === 0) return;
  const each = (read: (stream: VideoStream) => number) => () =>
    streams.map((stream): [string, number] => [stream.camera.name, read(stream)]);

  metrics.sums(
    'video_frames',
    'Frames encoded, by camera',
    'camera',
    each(({ counters }) => counters.frames),
  );
  metrics.sums(
    'video_key_frames',
    'Of these, frames that need no other, by camera',
    'camera',
    each(({ counters }) => counters.keyFrames),
  );
  metrics.sums(
    'video_bytes',
    'Bytes of the encoded frames, by camera',
    'camera',
    each(({ counters }) => counters.bytes),
  );
  metrics.sums(
    'video_frames_skipped',
    'Pictures that came but were not encoded, because all was too slow or they were damaged, by camera',
    'camera',
    each(({ dropped }) => dropped),
  );
  metrics.gauges(
    'video_bits_per_second',
    'Rate that the encoder is set to, by camera; 0 while nobody watches',
    'camera',
    each(({ format }) => format?.bitsPerSecond ?? 0),
  );
  metrics.sums(
    'video_failures',
    'Times that a camera’s encoder, or the thread that feeds it, ended or hung, by reason',
    'reason',
    () => streams.flatMap(({ failures }) => [...failures.entries()]),
  );
  metrics.gauges(
    'video_fault',
    'Whether a camera gives no pictures although somebody watches, by camera',
    'camera',
    each(({ fault }) => (fault === null ? 0 : 1)),
  );
  metrics.gauges(
    'video_frames_unsent',
    'Frames not sent, by reason, for operators connected now',
    'reason',
    () => [...operators.values()].flatMap(({ videos: { sender } }) => Object.entries(sender?.drops ?? {})),
  );
}
