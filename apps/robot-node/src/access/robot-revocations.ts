import {
  type GrantKeys,
  type RevocableGrant,
  RevocationList,
  RevocationsRefusedError,
  readRevocations,
  verifyRevocations,
} from '@farpoint/grants';
import type { Logger } from '@farpoint/service';
import { TokenBucket } from '@farpoint/timing';
import { LimitedLines } from '../telemetry/limited-lines.ts';
import type { ReasonCounts } from '../telemetry/robot-counters.ts';
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

interface KnownList {
  list: RevocationList;
  text: string;
}

/** Which grants the robot takes no more: its issuer has revoked them, or a supervisor has blocked them here. */
export class RobotRevocations {
  readonly #options: RobotRevocationsOptions;
  /** The newest list of each key, by `kid`. */
  readonly #lists = new Map<string, KnownList>();
  /** When blocked grants end, seconds since 1970, by `kid` and id. */
  readonly #blocked = new Map<string, Map<string, number>>();
  readonly #waiting = new Set<string>();
  /** To verify a list takes time, and the signaling service need not be trusted. */
  readonly #work = new TokenBucket({ perSecond: 10, burst: 64 });
  readonly #reports = new LimitedLines();

  constructor(options: RobotRevocationsOptions) {
    this.#options = options;
    const { lists, blocked } = options.journal.start;
    for (const text of lists) {
      const revocations = readRevocations(text);
      this.#lists.set(revocations.keyId, { list: new RevocationList(revocations), text });
    }
    for (const { keyId, id, expiresAtS } of blocked) this.#remember(keyId, id, expiresAtS);
  }

  /**
   * Takes a list, if it is genuine and newer than the one that is known. Never rejects.
   *
   * @param from the signaling service, or the robot's own file: its path
   */
  async take(text: string, from: string): Promise<void> {
    const { keys, outcomes, log, now } = this.#options;
    for (const known of this.#lists.values()) if (known.text === text) return;
    const sent = from === SIGNALING;
    // Whatever the service sends, the robot's own files are read.
    if (sent && !this.#work.take(now())) {
      outcomes.add('rate-limited');
      return;
    }
    try {
      const revocations = await verifyRevocations(text, keys());
      const list = new RevocationList(revocations);
      const known = this.#lists.get(list.keyId);
      if (known !== undefined && list.sequence <= known.list.sequence) {
        throw new RevocationsRefusedError(
          'revocations-older',
          `its sequence is ${list.sequence}, and ${known.list.sequence} is known`,
        );
      }
      this.#lists.delete(list.keyId);
      this.#lists.set(list.keyId, { list, text });
      outcomes.add('taken');
      const { grants, subjects, iss } = revocations.payload;
      const facts = { keyId: list.keyId, sequence: list.sequence, issuer: iss };
      log.info(
        { from, ...facts, grants: grants.length, subjects: subjects.length },
        'revoked grants: a newer list',
      );
      this.#save();
    } catch (error) {
      if (!(error instanceof RevocationsRefusedError)) {
        log.error({ err: error, from }, 'a list of revoked grants could not be verified');
        return;
      }
      if (sent && error.reason === 'revocations-untrusted') this.#wait(text);
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
    if (this.#lists.get(grant.keyId)?.list.revokes(grant, nowS) === true) return 'grant-revoked';
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

  #remember(keyId: string, id: string, expiresAtS: number): void {
    const ends = this.#blocked.get(keyId) ?? new Map<string, number>();
    ends.set(id, expiresAtS);
    this.#blocked.set(keyId, ends);
  }

  #wait(text: string): void {
    this.#waiting.delete(text);
    this.#waiting.add(text);
    for (const oldest of this.#waiting) {
      if (this.#waiting.size <= MAX_WAITING) break;
      this.#waiting.delete(oldest);
    }
  }

  #save(): void {
    const { keys, journal, log } = this.#options;
    // A list stays while its key is away, in case it comes back.
    for (const keyId of this.#lists.keys()) {
      if (this.#lists.size <= MAX_LISTS) break;
      if (!keys().has(keyId)) this.#lists.delete(keyId);
    }
    const blocked = [...this.#blocked].flatMap(([keyId, ends]) =>
      [...ends].map(([id, expiresAtS]) => ({ keyId, id, expiresAtS })),
    );
    try {
      journal.write({ lists: [...this.#lists.values()].map(({ text }) => text), blocked });
    } catch (error) {
      log.error({ err: error }, 'revoked grants cannot be stored: a restart of the robot would forget them');
    }
  }
}
