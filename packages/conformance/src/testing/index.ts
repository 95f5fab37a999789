/** Stand-ins for the reference system's released programs, for tests. */
export * from './released-bridge.ts';
export * from './released-page.ts';
export * from './released-robot.ts';
export * from './released-signaling.ts';
