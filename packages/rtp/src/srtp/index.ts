export * from './srtp-cm-keys.ts';
export * from './srtp-cm-sealer.ts';
export * from './srtp-nonce.ts';
export * from './srtp-opener.ts';
export * from './srtp-sealer.ts';
