export * from './flow-record.ts';
export * from './measures.ts';
export * from './media-flow.ts';
export * as rfc8867 from './rfc8867.ts';
export * from './scenario.ts';
