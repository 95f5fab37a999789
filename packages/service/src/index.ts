export * from './admin-server.ts';
export * from './health.ts';
export * from './json-lines-file.ts';
export * from './logger.ts';
export * as schema from './option-schemas.ts';
export * from './option-table.ts';
export * from './options.ts';
export * from './program.ts';
export * from './shutdown.ts';
