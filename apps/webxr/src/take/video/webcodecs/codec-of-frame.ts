import type { VideoCodec } from '@farpoint/operator';

const CODECS: ReadonlyMap<string, VideoCodec> = new Map([
  ['video/h264', 'H264'],
  ['video/vp8', 'VP8'],
]);

/**
 * What a frame is coded with, as its metadata say. TypeScript's types do not have the member yet.
 *
 * @returns `null` where the browser does not tell
 */
export function codecOfFrame(metadata: object): VideoCodec | null {
  const { mimeType } = metadata as { mimeType?: unknown };
  return typeof mimeType === 'string' ? (CODECS.get(mimeType.toLowerCase()) ?? null) : null;
}
