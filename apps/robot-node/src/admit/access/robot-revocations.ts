import {
  type GrantKeys,
  KnownRevocations,
  type RevocableGrant,
  type Revocations,
  RevocationsRefusedError,
  verifyRevocations,
} from '@farpoint/grants';
import type { Logger } from '@farpoint/service';
import { TokenBucket } from '@farpoint/timing';
import { LimitedLines } from '../../ground/limited-lines.ts';
import type { ReasonCounts } from '../../ground/robot-counters.ts';
import { MAX_BLOCKED, MAX_LISTS, type RevocationJournal } from './revocation-journal.ts';

export interface RobotRevocationsOptions {
  /** The keys whose grants and lists count now. */
  keys: () => GrantKeys;
  journal: Pick<RevocationJournal, 'start' | 'write'>;
  /** What became of each list that arrived. */
  outcomes: ReasonCounts;
  log: Logger;
  /** Seconds since 1970. */
  nowS: () => number;
  /** A monotonic clock, ms. */
  now: () => number;
}

/** Where a list comes from that is not in a file of the robot's own. */
export const SIGNALING = 'signaling';
/** Lists whose key is not known, yet: it may be read a moment later. */
const MAX_WAITING = 16;

/** Lists that were taken and are sent again at every welcome. */
const MAX_SEEN = 64;

/** Which grants the robot takes no more: its issuer has revoked them, or a supervisor has blocked them here. */
export class RobotRevocations {
  readonly #options: RobotRevocationsOptions;
  /** What each key has revoked, by `kid`. */
  readonly #known = new Map<string, KnownRevocations>();
  /** Lists that have been taken, the latest last. */
  readonly #seen = new Set<string>();
  /** When blocked grants end, seconds since 1970, by `kid` and id. */
  readonly #blocked = new Map<string, Map<string, number>>();
  readonly #waiting = new Set<string>();
  /** To verify a list takes time, and the signaling service need not be trusted. */
  readonly #work = new TokenBucket({ perSecond: 10, burst: 64 });
  readonly #reports = new LimitedLines();

  constructor(options: RobotRevocationsOptions) {
    this.#options = options;
    const { revoked, blocked } = options.journal.start;
    for (const { keyId, sequence, ...entries } of revoked) {
      const known = new KnownRevocations(keyId);
      known.add({ seq: sequence, ...entries }, options.nowS());
      this.#known.set(keyId, known);
    }
    for (const { keyId, id, expiresAtS } of blocked) this.#remember(keyId, id, expiresAtS);
  }

  /**
   * Takes a list, if it is genuine. What was revoked before stays revoked, whatever the list says. Never rejects.
   *
   * @param from the signaling service, or the robot's own file: its path
   */
  async take(text: string, from: string): Promise<void> {
    const { keys, outcomes, log, now } = this.#options;
    if (this.#seen.has(text)) return;
    const sent = from === SIGNALING;
    // Whatever the service sends, the robot's own files are read.
    if (sent && !this.#work.take(now())) {
      outcomes.add('rate-limited');
      return;
    }
    try {
      const revocations = await verifyRevocations(text, keys());
      this.#add(revocations, text, from);
      this.#save();
    } catch (error) {
      if (!(error instanceof RevocationsRefusedError)) {
        log.error({ err: error, from }, 'a list of revoked grants could not be verified');
        return;
      }
      if (sent && error.reason === 'revocations-untrusted') keepLatest(this.#waiting, text, MAX_WAITING);
      outcomes.add(error.reason);
      if (this.#reports.take(now()) !== null) {
        log.warn(
          { from, reason: error.reason, detail: error.message },
          'a list of revoked grants is not used',
        );
      }
    }
  }

  /** The keys were read again: lists that the service sent may have come before their key. */
  async keysChanged(): Promise<void> {
    const waiting = [...this.#waiting];
    this.#waiting.clear();
    for (const text of waiting) await this.take(text, SIGNALING);
  }

  /** Why a grant is not taken any more; `null` if it is. */
  refusal(grant: RevocableGrant): 'grant-revoked' | 'grant-blocked' | null {
    const nowS = this.#options.nowS();
    if (this.#known.get(grant.keyId)?.revokes(grant, nowS) === true) return 'grant-revoked';
    return (this.#blocked.get(grant.keyId)?.get(grant.id) ?? 0) > nowS ? 'grant-blocked' : null;
  }

  /** @returns false if there is no room for another */
  block({ keyId, id }: RevocableGrant, expiresAtS: number): boolean {
    const nowS = this.#options.nowS();
    for (const ends of this.#blocked.values())
      for (const [each, endS] of ends) if (endS <= nowS) ends.delete(each);
    let count = 0;
    for (const ends of this.#blocked.values()) count += ends.size;
    if (count >= MAX_BLOCKED) return false;
    this.#remember(keyId, id, expiresAtS);
    this.#save();
    return true;
  }

  /** @throws {RevocationsRefusedError} if nothing in it is new */
  #add({ keyId, payload }: Revocations, text: string, from: string): void {
    const { outcomes, log, nowS } = this.#options;
    const known = this.#known.get(keyId) ?? new KnownRevocations(keyId);
    const sequence = known.sequence;
    const { added, missing, dropped } = known.add(payload, nowS());
    keepLatest(this.#seen, text, MAX_SEEN);
    if (added === 0 && payload.seq <= sequence) {
      const detail = `its sequence is ${payload.seq}, and ${sequence} is known`;
      throw new RevocationsRefusedError('revocations-older', detail);
    }
    this.#known.set(keyId, known);
    outcomes.add(missing === 0 ? 'taken' : 'taken-shrunk');
    const { grants, subjects, seq, iss } = payload;
    const facts = { from, keyId, sequence: seq, issuer: iss };
    log.info({ ...facts, grants: grants.length, subjects: subjects.length, added }, 'revoked grants: a list');
    if (missing > 0)
      log.warn({ ...facts, missing }, 'a newer list leaves out what is revoked still: it stays revoked');
    if (dropped > 0)
      log.error(
        { ...facts, dropped },
        'too many revoked grants: remove the key and issue grants with another',
      );
  }

  #remember(keyId: string, id: string, expiresAtS: number): void {
    const ends = this.#blocked.get(keyId) ?? new Map<string, number>();
    ends.set(id, expiresAtS);
    this.#blocked.set(keyId, ends);
  }

  #save(): void {
    const { keys, journal, log, nowS } = this.#options;
    // A list stays while its key is away, in case it comes back.
    for (const keyId of this.#known.keys()) {
      if (this.#known.size <= MAX_LISTS) break;
      if (!keys().has(keyId)) this.#known.delete(keyId);
    }
    const blocked = [...this.#blocked].flatMap(([keyId, ends]) =>
      [...ends].map(([id, expiresAtS]) => ({ keyId, id, expiresAtS })),
    );
    try {
      const revoked = [...this.#known.values()].map((known) => ({
        keyId: known.keyId,
        sequence: known.sequence,
        ...known.entries(nowS()),
      }));
      journal.write({ revoked, blocked });
    } catch (error) {
      log.error({ err: error }, 'revoked grants cannot be stored: a restart of the robot would forget them');
    }
  }
}

function keepLatest(texts: Set<string>, text: string, most: number): void {
  texts.delete(text);
  texts.add(text);
  for (const oldest of texts) {
    if (texts.size <= most) break;
    texts.delete(oldest);
  }
}
