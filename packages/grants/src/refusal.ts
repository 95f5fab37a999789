/** Why a grant or the proof that goes with it is refused. */
export const grantRefusals = [
  'grant-missing',
  'grant-malformed', // not a grant
  'grant-untrusted', // not signed by a key that counts here
  'grant-expired',
  'grant-revoked', // by its issuer
  'grant-blocked', // at this robot, by a supervisor
  'grant-not-yet', // valid only later, or issued in the future
  'grant-other-robot',
  'grant-other-audience', // made for something other than Farpoint
  'proof-missing',
  'proof-malformed', // not a proof
  'proof-wrong-key', // not the key that the grant names
  'proof-forged', // its signature does not match
  'proof-other-grant',
  'proof-other-robot',
  'proof-other-session',
  'proof-other-fingerprint', // other DTLS certificates than this session's
  'proof-stale', // made too long ago or in the future
] as const;
export type GrantRefusal = (typeof grantRefusals)[number];

/** Thrown for every grant and proof that is refused. Bad input causes no other exception. */
export class GrantRefusedError extends Error {
  override readonly name = 'GrantRefusedError';
  readonly reason: GrantRefusal;

  /** @param detail for the robot's owner; never sent to the operator */
  constructor(reason: GrantRefusal, detail: string) {
    super(`${reason}: ${detail}`);
    this.reason = reason;
  }
}

/**
 * What an operator is told. Exact where its own grant says as much; otherwise only that it is refused, because an
 * attacker learns from every difference.
 */
export function refusalText(reason: GrantRefusal): string {
  switch (reason) {
    case 'grant-missing':
      return 'this robot admits only operators with a grant';
    case 'grant-expired':
      return 'the grant has expired';
    case 'grant-revoked':
      return 'the grant has been revoked';
    case 'grant-blocked':
      return 'a supervisor of this robot has blocked the grant';
    case 'grant-not-yet':
      return 'the grant is not valid yet, by the robot’s clock';
    case 'grant-other-robot':
      return 'the grant does not cover this robot';
    case 'grant-malformed':
    case 'grant-untrusted':
    case 'grant-other-audience':
      return 'the grant is not valid here';
    case 'proof-stale':
      return 'the operator’s clock and the robot’s differ by more than five minutes';
    default:
      return 'the grant came without a proof that is valid for this session';
  }
}
