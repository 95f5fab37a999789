/** Both sides of an introduction: is this the robot that we know, and how does it learn who we are? */
import { makeProof, RobotIdentityError, soleFingerprint, verifyIdentity } from '@farpoint/grants';
import type { KnownRobots } from './known-robots.ts';
import { type ChosenGrant, grantFor, type OperatorCredentials } from './operator-credentials.ts';

/** Why a robot is taken for another than it says. */
export type StrangerReason =
  /** It proves another key than the one that is known. */
  | 'robot-key-changed'
  /** It proves no key although one is known, its proof is false, or its certificate changed within the session. */
  | 'robot-unproven';

/** A robot that shows another key than the one by which it is known. */
export interface ChangedRobotKey {
  /** The id under which the robot is known. */
  readonly robotId: string;
  /** Thumbprint of the key that is known. */
  readonly known: string;
  /** Thumbprint of the key that the robot proved. */
  readonly shown: string;
  /** Whether the known key comes from the operator's grant rather than from an earlier session. */
  readonly byGrant: boolean;
}

/** Thrown for an offer that does not come from the robot that is known by this id. */
export class StrangeRobotError extends Error {
  override readonly name = 'StrangeRobotError';
  readonly reason: StrangerReason;
  readonly changed: ChangedRobotKey | null;

  constructor(reason: StrangerReason, detail: string, changed: ChangedRobotKey | null = null) {
    super(detail);
    this.reason = reason;
    this.changed = changed;
  }
}

export interface SessionAdmissionOptions {
  robotId: string;
  session: string;
  known: KnownRobots;
  credentials: () => Promise<readonly OperatorCredentials[]>;
  /** Seconds since 1970. */
  nowS: () => number;
}

/** An offer, as the signaling service passed it on. */
export interface ReceivedOffer {
  readonly sdp: string;
  readonly identity?: string | undefined;
}

/** What goes with an answer. */
export interface ShownCredentials {
  grant?: string;
  proof?: string;
}

/** For one session: checks the robot's offers, and makes what goes with the operator's answers. */
export class SessionAdmission {
  readonly #options: SessionAdmissionOptions;
  /** Of the first offer; `undefined` before it. */
  #fingerprint: string | null | undefined;
  #robotKey: string | null = null;
  #grant: ChosenGrant | null = null;
  #shown = false;

  constructor(options: SessionAdmissionOptions) {
    this.#options = options;
  }

  /** Call for each offer, before anything of it is used, one after the other. @throws {StrangeRobotError} */
  async check({ sdp, identity }: ReceivedOffer): Promise<void> {
    const fingerprint = soleFingerprint(sdp);
    if (this.#fingerprint !== undefined) {
      // An ICE restart keeps the DTLS session; another certificate would begin one with somebody else.
      if (fingerprint === this.#fingerprint) return;
      throw new StrangeRobotError('robot-unproven', 'a later offer names another certificate');
    }
    const { robotId, session, known, credentials, nowS } = this.#options;
    this.#grant = await grantFor(await credentials(), robotId, nowS());
    const granted = this.#grant?.claims.robotKeys?.[robotId];
    const expected = granted ?? known.get(robotId);
    // Pages without a secure context have no cryptography. Whoever stands between could change such a page itself.
    if (identity !== undefined && globalThis.crypto?.subtle !== undefined) {
      try {
        if (fingerprint === null)
          throw new StrangeRobotError('robot-unproven', 'its offer does not name one certificate');
        this.#robotKey = await verifyIdentity(identity, {
          robot: robotId,
          session,
          robotFingerprint: fingerprint,
        });
      } catch (error) {
        if (!(error instanceof RobotIdentityError)) throw error;
        throw new StrangeRobotError('robot-unproven', error.message);
      }
    }
    if (expected !== undefined && this.#robotKey !== expected) {
      const shown = this.#robotKey;
      if (shown === null) throw new StrangeRobotError('robot-unproven', 'it does not prove its key');
      const changed = { robotId, known: expected, shown, byGrant: granted !== undefined };
      throw new StrangeRobotError('robot-key-changed', `its key is ${shown}, not ${expected}`, changed);
    }
    this.#fingerprint = fingerprint;
  }

  /** What to send with an answer: a grant and its proof with the first, nothing with others. */
  async show(answer: string): Promise<ShownCredentials> {
    if (this.#shown) return {};
    this.#shown = true;
    const operatorFingerprint = soleFingerprint(answer);
    const robotFingerprint = this.#fingerprint ?? null;
    if (this.#grant === null) return {};
    const { grant, key } = this.#grant;
    if (operatorFingerprint === null || robotFingerprint === null) return { grant };
    const { robotId: robot, session, nowS } = this.#options;
    const facts = { robot, session, operatorFingerprint, robotFingerprint };
    return { grant, proof: await makeProof(grant, facts, key, nowS()) };
  }

  /** The session is connected: DTLS has shown that the certificate, and so the key, is the robot's. */
  connected(): void {
    if (this.#robotKey !== null) this.#options.known.remember(this.#options.robotId, this.#robotKey);
  }
}
