import type { SctpGuest } from '../sctp-guest.ts';
import { data, FIRST, times, UNORDERED } from './bytes.ts';

/** Chunks in a packet of 1,200 bytes. */
const BUNDLE = 50;
/** Numbers behind gaps; fragments that wait on one stream; streams that wait. A peer's budget lets in as many at once. */
const [GAPS, HELD, STREAMS] = [900, 500, 50];
const [GAP_STREAM, HELD_STREAM, FIRST_STREAM] = [600, 601, 700];

/**
 * Packets after which the robot holds as much of a peer as it can: every second number missing, fragments of messages
 * without an end, on many streams. The first number of all is missing, so that nothing of it passes.
 */
export function worstState(guest: SctpGuest): Buffer[] {
  // The robot's own messages wait, too.
  guest.association.sendSack = async () => undefined;
  let tsn = guest.association.localTsn;
  const next = () => {
    tsn = (tsn + 2) >>> 0;
    return tsn;
  };
  const chunks = [
    ...Array.from({ length: GAPS }, () => data(next(), GAP_STREAM)),
    ...Array.from({ length: HELD }, () => data(next(), HELD_STREAM, UNORDERED)),
    ...Array.from({ length: STREAMS }, (_, n) => data(next(), FIRST_STREAM + n, FIRST)),
  ];
  return Array.from({ length: Math.ceil(chunks.length / BUNDLE) }, (_, n) =>
    guest.packet(...times(BUNDLE, (k) => chunks[n * BUNDLE + k] ?? [])),
  );
}
