export * from './adaptive-rate-controller.ts';
export * from './allocation.ts';
export * from './fixed-rate-controller.ts';
export * from './in-flight.ts';
export * from './pacer.ts';
export * from './probe-tester.ts';
export * from './rate-controller.ts';
export * from './report-rate-controller.ts';
