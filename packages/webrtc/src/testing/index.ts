export { mendSctp } from '../werift/mend-sctp.ts';
export * from './dtls-record.ts';
export * from './hello-at-once.ts';
export * from './host-addresses-offered.ts';
export * from './hostile-datagrams.ts';
