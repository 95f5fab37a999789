import type { MountpointMedia } from '@farpoint/janus';
import type { VideoCodec } from '@farpoint/protocol';

/** One of the dynamic ones (RFC 3551, 6), above those of eight videos. */
const CLOUD_PAYLOAD_TYPE = 111;
/** The lowest of the dynamic ones; each video has its own, because all are in one bundle. */
const FIRST_VIDEO_PAYLOAD_TYPE = 96;
/** Constrained baseline, which every WebRTC peer decodes. */
const H264_PARAMETERS = 'profile-level-id=42e01f;packetization-mode=1';

/** The `a=mid` of the clouds' m-line. */
export const CLOUD_MID = 'cloud';

/** The `a=mid` of a video's m-line. */
export function midOfVideo(video: number): string {
  return `v${video}`;
}

/** The m-lines of a robot's mountpoint: clouds first, then the videos by number. */
export function broadcastMedia(codecs: readonly VideoCodec[], clouds: boolean): MountpointMedia[] {
  const cloud: MountpointMedia = {
    mid: CLOUD_MID,
    type: 'audio',
    label: 'Clouds',
    codec: 'opus',
    pt: CLOUD_PAYLOAD_TYPE,
  };
  const videos = codecs.map(
    (codec, video): MountpointMedia => ({
      mid: midOfVideo(video),
      type: 'video',
      label: `Video ${video + 1}`,
      pt: FIRST_VIDEO_PAYLOAD_TYPE + video,
      ...(codec === 'H264' ? { codec: 'h264', fmtp: H264_PARAMETERS } : { codec: 'vp8' }),
    }),
  );
  return clouds ? [cloud, ...videos] : videos;
}
