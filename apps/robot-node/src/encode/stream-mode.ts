/** `auto`: our own coded formats to whoever reads them; `points64`: that to everyone. */
export const STREAM_MODES = ['auto', 'points64'] as const;
export type StreamMode = (typeof STREAM_MODES)[number];
