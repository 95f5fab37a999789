/** The m-lines of cameras' videos: ordinary ones, which any WebRTC client can show; and what operators are told of them. */

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

/** One of the robot's cameras that is streamed as video on an m-line of its own. */
export interface VideoDescription {
  /** For people. */
  name: string;
  /** `a=mid` of its m-line in the robot's offer. */
  mid: string;
  /** What it is encoded with now, for every operator; it may change while the video runs. */
  codec: VideoCodec;
  /** Why there are no pictures at present, for people; absent while there are. */
  fault?: string | undefined;
  /**
   * Number of the sensor whose own colour picture this is: seen by the same lens from the same place, and captured with
   * its clouds. Absent for any other camera.
   */
  ofSensor?: number | undefined;
}

/**
 * The videos of the robot's cameras; a video's position in the list is its number. Sent after the welcome by robots
 * with such cameras, and again whenever a video's state or codec changes.
 */
export interface Videos {
  type: 'videos';
  /** In the order of their numbers. */
  videos: VideoDescription[];
}
