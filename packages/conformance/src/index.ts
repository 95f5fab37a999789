export * from './finding.ts';
export * from './frames.ts';
export * from './offer-rules.ts';
export * from './peers/inbox.ts';
export * from './peers/reference-operator.ts';
export * from './peers/reference-robot.ts';
export * from './peers/socket-peer.ts';
export * from './rtp-rules.ts';
