import type { PulledMetrics } from '@farpoint/service';
import type { VideoStream } from '../../sense/video/video-stream.ts';
import type { OperatorSession } from '../../serve/session/operator-session.ts';
import type { MeasuredRobot } from './measured-robot.ts';

/** Metrics of the cameras that are streamed as video. None if the robot has no such camera. */
export function addVideoMetrics(metrics: PulledMetrics, robot: MeasuredRobot): void {
  const { streams } = robot.streams.cameras.videos;
  if (streams.length === 0) return;
  addEncodedMetrics(metrics, streams);
  metrics.sums(
    'video_failures',
    'Times that a camera’s encoder, or the thread that feeds it, ended or hung, by reason',
    'reason',
    () => streams.flatMap(({ failures }) => [...failures.entries()]),
  );
  metrics.gauges(
    'video_frames_unsent',
    'Frames not sent, by reason, for operators connected now',
    'reason',
    () =>
      [...robot.operators.values()].flatMap(({ videos: { sender } }) => Object.entries(sender?.drops ?? {})),
  );
}

type Streams = readonly VideoStream[];

function byCamera(streams: Streams, read: (stream: VideoStream) => number): () => [string, number][] {
  return () => streams.map((stream) => [stream.camera.name, read(stream)]);
}

function addEncodedMetrics(metrics: PulledMetrics, streams: Streams): void {
  metrics.sums(
    'video_frames',
    'Frames encoded, by camera',
    'camera',
    byCamera(streams, ({ counters }) => counters.frames),
  );
  metrics.sums(
    'video_key_frames',
    'Of these, frames that need no other, by camera',
    'camera',
    byCamera(streams, ({ counters }) => counters.keyFrames),
  );
  metrics.sums(
    'video_bytes',
    'Bytes of the encoded frames, by camera',
    'camera',
    byCamera(streams, ({ counters }) => counters.bytes),
  );
  metrics.sums(
    'video_frames_skipped',
    'Pictures that came but were not encoded, because all was too slow or they were damaged, by camera',
    'camera',
    byCamera(streams, ({ dropped }) => dropped),
  );
  metrics.gauges(
    'video_bits_per_second',
    'Rate that the encoder is set to, by camera; 0 while nobody watches',
    'camera',
    byCamera(streams, ({ format }) => format?.bitsPerSecond ?? 0),
  );
}

/** Metrics of devices that operators want something of and that cannot give it. */
export function addDeviceMetrics(
  metrics: PulledMetrics,
  { streams: { cameras, sound } }: Pick<MeasuredRobot, 'streams'>,
): void {
  const { microphone, loudspeaker, hasMicrophone } = sound;
  metrics.gauges(
    'device_fault',
    '1 for a camera, microphone or loudspeaker that fails, otherwise 0',
    'device',
    () => [
      ...cameras.videos.streams.map(({ camera, fault }) => [camera.name, fault === null ? 0 : 1] as const),
      ...(hasMicrophone ? [['microphone', microphone.fault === null ? 0 : 1] as const] : []),
      ...(loudspeaker === null ? [] : [['loudspeaker', loudspeaker.fault === null ? 0 : 1] as const]),
    ],
  );
}

/** Metrics of the robot's microphone and loudspeaker. None if it has neither. */
export function addSoundMetrics(
  metrics: PulledMetrics,
  { streams: { sound }, operators }: MeasuredRobot,
): void {
  const { microphone, loudspeaker, hasMicrophone } = sound;
  if (hasMicrophone) {
    metrics.gauge('sound_listeners', 'Operators who are sent the microphone’s sound', () => sound.listeners);
    metrics.sum('sound_packets', 'Packets of sound encoded', () => microphone.counters.packets);
    metrics.gauge(
      'sound_bits_per_second',
      'Rate that the microphone’s encoder is set to; 0 while nobody listens',
      () => microphone.bitsPerSecond,
    );
  }
  if (loudspeaker === null) return;
  metrics.gauge('voice_open', 'Whether an operator’s voice is being played', () =>
    sound.speaking === null ? 0 : 1,
  );
  metrics.sums('voice_packets', 'Packets of operators’ voices, by what became of them', 'outcome', () => [
    ...Object.entries(loudspeaker.counters),
    ...Object.entries(loudspeaker.drops),
  ]);
  metrics.gauges(
    'voice_packets_refused',
    'Packets from operators connected now that were not taken for a voice, by reason',
    'reason',
    () =>
      [...operators.values()].flatMap(({ sound: { line } }) => Object.entries(line?.voice?.refusals ?? {})),
  );
}

/** Metrics of camera pictures: made, lost, sent. None if the robot has no camera. */
export function addPictureMetrics(
  metrics: PulledMetrics,
  { streams: { cameras }, operators }: MeasuredRobot,
): void {
  const { pictures } = cameras;
  if (pictures === null) return;
  const made = pictures.counters;
  const total = (read: (operator: OperatorSession) => number) => () =>
    [...operators.values()].reduce((sum, operator) => sum + read(operator), 0);

  metrics.sum('pictures_made', 'Camera pictures prepared for sending', () => made.made);
  metrics.sums('pictures_lost', 'Pictures that could not be prepared, by reason', 'reason', () =>
    made.lost.entries(),
  );
  metrics.gauge(
    'pictures_sent',
    'Pictures sent to operators connected now',
    total(({ pictures: sender }) => sender.picturesSent),
  );
  metrics.gauge(
    'picture_bytes_sent',
    'Bytes on the wire of pictures to operators connected now',
    total(({ pictures: sender }) => sender.bytesSent),
  );
  metrics.gauges(
    'pictures_unsent',
    'Pictures not sent, or only in part, by reason, for operators connected now',
    'reason',
    () => [...operators.values()].flatMap(({ pictures: sender }) => Object.entries(sender.drops)),
  );
}
