export * from './capacity.ts';
export * from './congestion-window.ts';
export * from './cross-flow.ts';
export * from './link-model.ts';
export * from './link-statistics.ts';
export { type BurstLoss, burstLossOf } from './loss.ts';
export * from './profile.ts';
export * from './tcp-flow.ts';
export * from './trace.ts';
