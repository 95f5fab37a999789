/**
 * Bytes on the wire in addition to a message's text: SCTP chunk and header 28, DTLS record 37, UDP and IPv4 28 bytes.
 */
export const MESSAGE_OVERHEAD_BYTES = 93;
/** Unreliable messages are dropped while more than this is queued, bytes. */
export const MAX_UNRELIABLE_BACKLOG = 16_384;
/** A peer is closed when more than this is queued on its reliable channel, bytes. */
export const MAX_RELIABLE_BACKLOG = 262_144;
