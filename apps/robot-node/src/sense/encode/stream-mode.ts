/** `auto`: our own coded formats for everyone who reads them; `points64`: only `points64`, for everyone. */
export const STREAM_MODES = ['auto', 'points64'] as const;
export type StreamMode = (typeof STREAM_MODES)[number];
