/** Stand-ins for the reference system's released programs, and for our page on a bridge's sockets; for tests. */
export * from './farpoint-page.ts';
export * from './released-bridge.ts';
export * from './released-frames.ts';
export * from './released-page.ts';
export * from './released-robot.ts';
export * from './released-signaling.ts';
