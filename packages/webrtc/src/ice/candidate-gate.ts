/**
 * Which of a peer's ICE candidates may go to the ICE agent, and when: none before the description that it belongs to is
 * set, none of another generation, none that could not be used. Pure.
 */
import type { IceCandidate } from '@farpoint/protocol';

/** Why a candidate is left out. */
export const candidateRefusals = [
  'malformed', // no candidate of RFC 8839
  'not-udp', // points over TCP would arrive late in heaps
  'old-generation', // of a description that another has replaced
  'queue-full', // too many wait for their description; the oldest goes
  'too-many', // more than are meant to connect anything
  'unusable', // the ICE agent refuses it
] as const;
export type CandidateRefusal = (typeof candidateRefusals)[number];

/** `wait`: the gate keeps it until {@link CandidateGate.open}. `end`: there are no more, as far as the peer knows. */
export type CandidateVerdict = 'add' | 'wait' | 'end' | CandidateRefusal;

export interface CandidateLimits {
  /** That wait for their description. */
  waiting: number;
  /** Of one description. */
  added: number;
  /** Of those, names that have to be looked up. */
  names: number;
}

const LIMITS: CandidateLimits = { waiting: 64, added: 128, names: 16 };
/** Username fragments of former generations that are remembered. */
const MAX_PAST_FRAGMENTS = 32;

// candidate:foundation component transport priority address port typ …
const CANDIDATE =
  /^(?:candidate:)?[\w+/]{1,32} \d{1,5} (?<transport>\S{1,16}) \d{1,10} (?<address>\S{1,255}) \d{1,5} typ \S+(?: .*)?$/;

export class CandidateGate {
  readonly #limits: CandidateLimits;
  #waiting: IceCandidate[] = [];
  /** Username fragments of the description that is set; `null` while one is awaited. */
  #current: ReadonlySet<string> | null = null;
  readonly #past = new Set<string>();
  #added = 0;
  #names = 0;

  constructor(limits: Partial<CandidateLimits> = {}) {
    this.#limits = { ...LIMITS, ...limits };
  }

  get waiting(): number {
    return this.#waiting.length;
  }

  /** Another description is awaited: what comes may belong to it. */
  hold(): void {
    for (const fragment of this.#current ?? []) this.#past.add(fragment);
    for (const fragment of this.#past) {
      if (this.#past.size <= MAX_PAST_FRAGMENTS) break;
      this.#past.delete(fragment);
    }
    this.#current = null;
  }

  /**
   * A description with these username fragments is set.
   *
   * @returns what waited for it, in the order it came; each is to be taken again
   */
  open(fragments: Iterable<string>): IceCandidate[] {
    this.hold();
    this.#current = new Set(fragments);
    for (const fragment of this.#current) this.#past.delete(fragment);
    this.#added = 0;
    this.#names = 0;
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
    const isName = groups.address?.toLowerCase().endsWith('.local') === true;
    if (this.#added >= this.#limits.added || (isName && this.#names >= this.#limits.names)) return 'too-many';
    this.#added++;
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
  /** Without candidates, and without saying that there are no more. */
  sdp: string;
  candidates: IceCandidate[];
  /** The description's username fragments. */
  fragments: Set<string>;
}

/** Takes the candidates out of a session description, to go through the gate as trickled ones do. Takes any text. */
export function takeCandidates(sdp: string): TakenApart {
  const candidates: IceCandidate[] = [];
  const fragments = new Set<string>();
  let mLineIndex = -1;
  // Lines with what ends them, so that nothing else changes.
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
