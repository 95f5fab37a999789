export * from './bridge-process.ts';
export * from './chromium.ts';
export * from './emulated-link.ts';
export * from './free-port.ts';
export * from './managed-process.ts';
export * from './stack.ts';
export * from './turn-server.ts';
