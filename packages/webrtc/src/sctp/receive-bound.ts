/**
 * Bounds what an SCTP association holds of messages that are not complete. werift assembles whatever arrives, of any
 * length, and looks through all fragments at each new one: a message of 4 MB keeps it busy for a fifth of a second.
 */
import { FIRST_FRAGMENT, LAST_FRAGMENT } from './layout.ts';
import { MAX_AHEAD } from './tsn-window.ts';

/** As our descriptions announce (`a=max-message-size`): no peer may send a longer message (RFC 8841 §6.1), bytes. */
export const MAX_MESSAGE_BYTES = 65_536;
/** Fragments of all streams together that wait for others, bytes. */
const MAX_HELD_BYTES = 4 * MAX_MESSAGE_BYTES;
/** The same by number, because fragments may be as short as a byte. */
const MAX_HELD_FRAGMENTS = 1024;
/** A session needs six; each costs memory as soon as something arrives on it. */
export const MAX_STREAMS = 64;
/** How often an operator may open a channel; a session needs it twice. */
export const MAX_OPENINGS = 256;

/** A DATA chunk (RFC 9260 §3.3.1). */
export interface Fragment {
  tsn: number;
  streamId: number;
  flags: number;
  userData: { readonly length: number };
}

export interface ReceivedState {
  /** Fragments that wait for others, by stream, in the order of their numbers. */
  streams: Readonly<Record<number, { readonly reassembly: readonly Fragment[] } | undefined>>;
  /** The last number that was received in order; undefined before the association's first. */
  lastTsn: number | undefined;
}

/** Why a fragment is not kept. */
export type Excess = 'message-too-large' | 'sctp-overfull' | 'too-many-channels';

/** @returns `null` if the fragment may be kept */
export function excessOf(fragment: Fragment, { streams, lastTsn }: ReceivedState): Excess | null {
  if (lastTsn !== undefined) {
    const ahead = (fragment.tsn - lastTsn) >>> 0;
    // More than half of all numbers ahead is behind: a duplicate.
    if (ahead > MAX_AHEAD && ahead < 2 ** 31) return 'sctp-overfull';
  }
  const stream = streams[fragment.streamId];
  if (stream === undefined && Object.keys(streams).length >= MAX_STREAMS) return 'sctp-overfull';
  const held = stream?.reassembly ?? [];
  if (fragment.userData.length + bytesBefore(fragment, held) > MAX_MESSAGE_BYTES) return 'message-too-large';
  let [bytes, fragments] = [fragment.userData.length, 1];
  for (const id in streams) {
    for (const { userData } of streams[id]?.reassembly ?? []) {
      bytes += userData.length;
      fragments++;
    }
  }
  return bytes > MAX_HELD_BYTES || fragments > MAX_HELD_FRAGMENTS ? 'sctp-overfull' : null;
}

/** Length of the fragments of the same message directly before this one: their numbers are consecutive (§6.9). */
function bytesBefore({ tsn, flags }: Fragment, held: readonly Fragment[]): number {
  if ((flags & FIRST_FRAGMENT) !== 0) return 0;
  let bytes = 0;
  let expected = (tsn - 1) >>> 0;
  for (let at = held.length - 1; at >= 0; at--) {
    const other = held[at] as Fragment;
    if (other.tsn !== expected) {
      if (bytes > 0) break;
      continue;
    }
    if ((other.flags & LAST_FRAGMENT) !== 0) break;
    bytes += other.userData.length;
    if ((other.flags & FIRST_FRAGMENT) !== 0) break;
    expected = (expected - 1) >>> 0;
  }
  return bytes;
}
