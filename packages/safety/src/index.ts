export * from './command-gate.ts';
export * from './drive-guard.ts';
export * from './estop.ts';
export * from './lease.ts';
export * from './limits.ts';
export * from './queueing-delay.ts';
export * from './rejection-reporter.ts';
export * from './watchdog.ts';
