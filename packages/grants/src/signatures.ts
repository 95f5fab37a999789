/**
 * What signs and verifies, of jose. It stands in a module of its own that is loaded when something is signed or verified for the
 * first time: a page without a grant, at a robot that proves no key, never loads it. Import it as
 * `await import('./signatures.ts')`, outside of any `try` whose `catch` means a bad key or signature: that it cannot be loaded is
 * another fault.
 *
 * - `CompactSign`, `compactVerify`: compact JWS (RFC 7515)
 * - `importJWK`, `exportJWK`, `generateKeyPair`: keys (RFC 7517)
 * - `calculateJwkThumbprint`: RFC 7638
 * - `errors`: what these throw
 */
export {
  CompactSign,
  calculateJwkThumbprint,
  compactVerify,
  errors,
  exportJWK,
  generateKeyPair,
  importJWK,
} from 'jose';
