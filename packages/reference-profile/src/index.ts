export * from './candidate-gate.ts';
export * from './channels.ts';
export * from './ice-sockets.ts';
export * from './message-line.ts';
export * from './peer-connection.ts';
export * from './remote-candidates.ts';
export * from './rtp-tap.ts';
