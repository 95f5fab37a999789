export * from './base-state.ts';
export * from './frame-source.ts';
export * from './played-telemetry.ts';
export * from './source-picture.ts';
