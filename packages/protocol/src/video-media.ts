/** The m-lines of cameras' videos: ordinary ones, which any WebRTC client can show. */

/** In how many videos a robot can offer its cameras, at most. */
export const MAX_VIDEOS = 8;

/** The codecs that a camera's video may have, as SDP names them. */
export const VIDEO_CODECS = ['H264', 'VP8'] as const;
/** A codec of cameras' videos, as SDP names it. */
export type VideoCodec = (typeof VIDEO_CODECS)[number];

/** RTP timestamps of a video count in this unit, 1/s: they are the capture time on the robot's monotonic clock. */
export const VIDEO_CLOCK_RATE = 90_000;

/**
 * The `MediaStream` of a video. Each has its own, because a browser delays tracks of one stream to play them in step,
 * by rules of its own.
 *
 * @param video the video's number
 */
export function videoStreamId(video: number): string {
  return `farpoint-video-${video}`;
}
