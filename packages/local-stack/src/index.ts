export * from './chromium.ts';
export * from './free-port.ts';
export * from './managed-process.ts';
export * from './stack.ts';
