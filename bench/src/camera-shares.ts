/** How a link was divided among clouds and videos, beside how the operator asked for it. */

/** `4:2,1`: weights of all clouds together, and of each video. */
export interface AskedShares {
  cloud: number;
  videos: number[];
}

/** A stream's part of the link, 0–1. */
export interface SharePair {
  stream: string;
  asked: number;
  seen: number;
}

/** What RTP, SRTP, UDP and IP headers add to a video's bytes, as a factor. */
const VIDEO_OVERHEAD = 1.07;

/** @throws {Error} naming what is wrong */
export function parseShares(text: string, cameras: number): AskedShares {
  const match = /^(\d{1,3}):(\d{1,3}(?:,\d{1,3})*)$/.exec(text);
  const videos = match?.[2]?.split(',').map(Number) ?? [];
  if (match === null || videos.length !== cameras)
    throw new Error(`--shares: \`${text}\` is not like 4:2,1,1, with a weight for each camera`);
  return { cloud: Number(match[1]), videos };
}

/**
 * @param bytesSent of all streams together, on the wire
 * @param videoBytes of the encoded pictures, by camera
 */
export function sharesSeen(
  asked: AskedShares,
  bytesSent: number,
  videoBytes: readonly number[],
): SharePair[] {
  const weights = asked.cloud + asked.videos.reduce((sum, weight) => sum + weight, 0);
  const onWire = videoBytes.map((bytes) => bytes * VIDEO_OVERHEAD);
  const cloud = bytesSent - onWire.reduce((sum, bytes) => sum + bytes, 0);
  const pair = (stream: string, weight: number, bytes: number): SharePair => ({
    stream,
    asked: Number((weight / weights).toFixed(3)),
    seen: Number((bytes / Math.max(bytesSent, 1)).toFixed(3)),
  });
  return [
    pair('clouds', asked.cloud, cloud),
    ...asked.videos.map((weight, i) => pair(`camera ${i + 1}`, weight, onWire[i] ?? 0)),
  ];
}
