/** Chains for tests. */

import { CHAIN_START, makeEntry } from '../audit-entry.ts';
import type { AuditEvent } from '../audit-event.ts';
import {
  type ChainFault,
  ChainVerifier,
  type ChainVerifierOptions,
  type VerifiedChain,
} from '../chain-verifier.ts';

export const EVENTS: readonly AuditEvent[] = [
  { kind: 'started', details: { version: '0.1.0', limits: { maxLinear: 0.5 } } },
  { kind: 'session-began', session: '0123456789ab', subject: { name: 'Åda', proven: false } },
  {
    ...{ kind: 'lease-given', session: '0123456789ab', robot: 'r1' },
    subject: { id: 'ada', name: 'Ada', role: 'drive', grant: 'g1', proven: true },
  },
  { kind: 'estop-latched', details: { by: 'operator' } },
  { kind: 'stopped' },
];

/** The lines of a chain with their newlines, one for each event. */
export function chainOf(events: readonly AuditEvent[], startMs = 1e12): string[] {
  let end = CHAIN_START;
  return events.map((event, i) => {
    const made = makeEntry(end, event, startMs + i);
    end = made.end;
    return made.line;
  });
}

export function verify(
  files: readonly (string | Uint8Array)[],
  options: ChainVerifierOptions = {},
): VerifiedChain | ChainFault {
  const verifier = new ChainVerifier(options);
  for (const [i, file] of files.entries()) {
    verifier.beginFile(`f${i}`);
    verifier.push(Buffer.from(file));
  }
  return verifier.end();
}
