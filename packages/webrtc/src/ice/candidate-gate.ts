/**
 * Decides which of a peer's ICE candidates may go to the ICE agent, and when: none before its description is set, none
 * of another generation, none that is unusable. Pure.
 */
import type { IceCandidate } from '@farpoint/protocol';

/** Why a candidate is left out. */
export const candidateRefusals = [
  'malformed', // not a candidate as in RFC 8839
  'not-udp', // over TCP, points would arrive late and in bursts
  'old-generation', // its description has been replaced by another
  'queue-full', // too many candidates wait for their description; the oldest is dropped
  'repeated', // the same address and port again: each would be checked, and could be somebody else's
  'too-many', // more than any real connection needs
  'unusable', // the ICE agent refuses it
] as const;
export type CandidateRefusal = (typeof candidateRefusals)[number];

/** `wait`: the gate keeps it until {@link CandidateGate.open}. `end`: the peer knows no more candidates. */
export type CandidateVerdict = 'add' | 'wait' | 'end' | CandidateRefusal;

export interface CandidateLimits {
  /** Candidates that wait for their description. */
  waiting: number;
  /** Candidates added for one description. */
  added: number;
  /** How many of those are names that need a look-up. */
  names: number;
  /** How many may have the same address, with different ports: a NAT has one for each of the peer's interfaces. */
  sameAddress: number;
}

const LIMITS: CandidateLimits = { waiting: 64, added: 128, names: 16, sameAddress: 16 };
/** How many username fragments of former generations are remembered. */
const MAX_PAST_FRAGMENTS = 32;

// candidate:foundation component transport priority address port typ …
const CANDIDATE =
  /^(?:candidate:)?[\w+/]{1,32} \d{1,5} (?<transport>\S{1,16}) \d{1,10} (?<address>\S{1,255}) (?<port>\d{1,5}) typ \S+(?: .*)?$/;

export class CandidateGate {
  readonly #limits: CandidateLimits;
  #waiting: IceCandidate[] = [];
  /** Username fragments of the current description; `null` while one is awaited. */
  #current: ReadonlySet<string> | null = null;
  readonly #past = new Set<string>();
  #added = 0;
  #names = 0;
  /** The ports of each address that were added. */
  readonly #ports = new Map<string, Set<number>>();

  constructor(limits: Partial<CandidateLimits> = {}) {
    this.#limits = { ...LIMITS, ...limits };
  }

  get waiting(): number {
    return this.#waiting.length;
  }

  /** Another description is awaited, and candidates that arrive now may belong to it. */
  hold(): void {
    for (const fragment of this.#current ?? []) this.#past.add(fragment);
    for (const fragment of this.#past) {
      if (this.#past.size <= MAX_PAST_FRAGMENTS) break;
      this.#past.delete(fragment);
    }
    this.#current = null;
  }

  /**
   * A description with these username fragments has been set.
   *
   * @returns the candidates that waited for it, in order of arrival; submit each of them again
   */
  open(fragments: Iterable<string>): IceCandidate[] {
    this.hold();
    this.#current = new Set(fragments);
    for (const fragment of this.#current) this.#past.delete(fragment);
    this.#added = 0;
    this.#names = 0;
    this.#ports.clear();
    return this.#waiting.splice(0);
  }

  take(candidate: IceCandidate): CandidateVerdict {
    const text = candidate.candidate;
    if (text === '') return 'end';
    const groups = /[\r\n]/.test(text) ? undefined : CANDIDATE.exec(text)?.groups;
    if (groups === undefined) return 'malformed';
    if (groups.transport?.toLowerCase() !== 'udp') return 'not-udp';
    const fragment = candidate.usernameFragment ?? / ufrag (\S+)/.exec(text)?.[1];
    if (this.#current === null) return this.#wait(candidate);
    if (fragment !== undefined && !this.#current.has(fragment)) {
      return this.#past.has(fragment) ? 'old-generation' : this.#wait(candidate);
    }
    const address = groups.address?.toLowerCase() ?? '';
    const ports = this.#ports.get(address) ?? new Set();
    if (ports.has(Number(groups.port))) return 'repeated';
    if (ports.size >= this.#limits.sameAddress) return 'too-many';
    const isName = address.endsWith('.local');
    if (this.#added >= this.#limits.added || (isName && this.#names >= this.#limits.names)) return 'too-many';
    this.#added++;
    this.#ports.set(address, ports.add(Number(groups.port)));
    if (isName) this.#names++;
    return 'add';
  }

  #wait(candidate: IceCandidate): CandidateVerdict {
    this.#waiting.push(candidate);
    if (this.#waiting.length <= this.#limits.waiting) return 'wait';
    this.#waiting.shift();
    return 'queue-full';
  }
}

export interface TakenApart {
  /** Without candidates and without the end-of-candidates line. */
  sdp: string;
  candidates: IceCandidate[];
  /** The description's username fragments. */
  fragments: Set<string>;
}

/**
 * Removes the candidates from a session description, so that they pass the gate like trickled ones. Accepts any text.
 */
export function takeCandidates(sdp: string): TakenApart {
  const candidates: IceCandidate[] = [];
  const fragments = new Set<string>();
  let mLineIndex = -1;
  // Lines keep their line endings, so that nothing else changes.
  const lines = sdp.split(/(?<=\n)/).filter((line) => {
    const text = line.trimEnd();
    if (text.startsWith('m=')) mLineIndex++;
    else if (text.startsWith('a=ice-ufrag:')) fragments.add(text.slice('a=ice-ufrag:'.length));
    else if (text === 'a=end-of-candidates') return false;
    else if (text.startsWith('a=candidate:') && mLineIndex >= 0) {
      candidates.push({ candidate: text.slice('a='.length), sdpMLineIndex: mLineIndex });
      return false;
    }
    return true;
  });
  return { sdp: lines.join(''), candidates, fragments };
}
