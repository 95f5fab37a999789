export * from './srtp-nonce.ts';
export * from './srtp-opener.ts';
export * from './srtp-sealer.ts';
