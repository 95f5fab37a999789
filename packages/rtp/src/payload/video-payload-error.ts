/** Why an encoded picture cannot be split into RTP payloads. */
export type VideoPayloadFault =
  | 'empty' // no bytes at all
  | 'no-nal-unit' // H.264: not in Annex B's byte stream format, or nothing but start codes
  | 'bad-nal-unit' // H.264: a NAL unit of a type that RTP uses for itself, 0 or 24 to 31
  | 'limit-too-small'; // the longest payload has no room for a header and one byte

/** Thrown for a picture, or a limit, from which no payloads can be made. */
export class VideoPayloadError extends Error {
  override readonly name = 'VideoPayloadError';
  readonly reason: VideoPayloadFault;

  constructor(reason: VideoPayloadFault, detail: string) {
    super(`video payload: ${detail}`);
    this.reason = reason;
  }
}

/** @throws {VideoPayloadError} `limit-too-small` */
export function checkPayloadLimit(maxPayloadBytes: number, least: number): void {
  if (Number.isInteger(maxPayloadBytes) && maxPayloadBytes >= least) return;
  throw new VideoPayloadError('limit-too-small', `at most ${maxPayloadBytes} bytes, needs ${least}`);
}
