/**
 * The label of the point packets' m-line. Browsers refuse unknown payloads, so the points are labelled as audio; the
 * receiver's transform takes each packet before anything is decoded.
 */
export const CLOUD_MEDIA = { kind: 'audio', mimeType: 'audio/opus', clockRate: 48_000, channels: 2 } as const;

/** The only m-line of the reference profile: `5 pcm/90000`, with the transport-wide sequence number as extension 1. */
export const REFERENCE_MEDIA = {
  kind: 'video',
  mimeType: 'video/pcm',
  clockRate: 90_000,
  payloadType: 5,
  extensionId: 1,
} as const;
