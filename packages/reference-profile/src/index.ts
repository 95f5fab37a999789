export * from './message-line.ts';
export * from './peer-connection.ts';
export * from './sdp-answer.ts';
export * from './sdp-sections.ts';
