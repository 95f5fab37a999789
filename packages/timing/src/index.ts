export * from './backoff.ts';
export * from './bit-rate.ts';
export * from './heartbeat.ts';
export * from './rate-meter.ts';
export * from './reconnect.ts';
export * from './token-bucket.ts';
export * from './windowed-minimum.ts';
