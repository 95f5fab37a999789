/**
 * The layout of SCTP packets (RFC 9260 §3) as far as several files read it: lengths in bytes, types and flags.
 */

/** Ports, verification tag and checksum (§3.1). */
export const COMMON_HEADER_BYTES = 12;
/** Type, flags and length (§3.2). */
export const CHUNK_HEADER_BYTES = 4;
/** The type of acknowledgements (§3.3.4). */
export const SACK_CHUNK = 3;

/** Flags of a DATA chunk (§3.3.1): it ends a message, it begins one, and it may overtake others. */
export const LAST_FRAGMENT = 1;
export const FIRST_FRAGMENT = 2;
export const UNORDERED = 4;
