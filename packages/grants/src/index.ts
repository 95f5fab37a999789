export * from './admission.ts';
export { extendRevocations, type NewRevocations } from './extend-revocations.ts';
export * from './grant.ts';
export {
  AUDIENCE,
  coversRobot,
  type GrantClaims,
  grantClaimsSchema,
  MAX_GRANT_LENGTH,
  MAX_ROBOTS,
  MAX_SUBJECT_LENGTH,
  matchesPattern,
  robotKeysSchema,
  robotPatternSchema,
  sha256Schema,
  subjectSchema,
} from './grant-claims.ts';
export {
  algorithmOf,
  type GrantAlgorithm,
  type GrantKey,
  type GrantKeys,
  GrantKeysError,
  type GrantPublicJwk,
  grantAlgorithms,
  grantKeySchema,
  MAX_KEYS,
  parseGrantKeys,
  readJwkSet,
} from './grant-keys.ts';
export {
  KnownRevocations,
  MAX_KNOWN_REVOCATIONS,
  missingFrom,
  type RevocationEntries,
  type RevocationsChange,
} from './known-revocations.ts';
export * from './operator-key.ts';
export { MAX_PROOF_LENGTH, makeProof, PROOF_LEEWAY_S, type SessionFacts, verifyProof } from './proof.ts';
export * from './refusal.ts';
export {
  MAX_REVOCATIONS,
  type RevocableGrant,
  type Revocations,
  type RevocationsPayload,
  type RevocationsRefusal,
  RevocationsRefusedError,
  readRevocations,
  revocationsRefusals,
  signRevocations,
  verifyRevocations,
} from './revocations.ts';
export * from './robot-identity.ts';
export { makeSigningKey, type NewSigningKey, parseSigningKey, publicPartOf } from './signing-key.ts';
export { fingerprintSchema, soleFingerprint } from './sole-fingerprint.ts';
export * from './ticket.ts';
