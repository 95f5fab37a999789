/** What a message costs on the wire beyond its text: SCTP chunk and header 28, DTLS record 37, UDP and IPv4 28 bytes. */
export const MESSAGE_OVERHEAD_BYTES = 93;
/** Our unreliable messages are dropped while this much waits, bytes. */
export const MAX_UNRELIABLE_BACKLOG = 16_384;
/** A peer that lets this much of the reliable channel pile up is closed. */
export const MAX_RELIABLE_BACKLOG = 262_144;
