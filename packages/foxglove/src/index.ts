export type { LiveMessage } from './client-backlog.ts';
export type { ClientRefusal } from './live-client.ts';
export { type ConnectionRefusal, LiveListener, type LiveListenerOptions } from './live-listener.ts';
export { type LiveCounts, LiveServer, type LiveServerEvents } from './live-server.ts';
export type { ChannelSpec } from './server-message.ts';
