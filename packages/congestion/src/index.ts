export * from './fixed-rate-controller.ts';
export * from './pacer.ts';
export * from './rate-controller.ts';
export * from './rtcp.ts';
export * from './sent-packet-history.ts';
export * from './transport-feedback.ts';
export * from './transport-feedback-adapter.ts';
