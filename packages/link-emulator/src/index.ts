export * from './candidate.ts';
export * from './lateness.ts';
export * from './signaling-interposer.ts';
export * from './signaling-messages.ts';
export * from './udp-link.ts';
