export { type Unproven, UnprovenPeerError } from './dtls/peer-proof.ts';
export { type Refusal, Refusals } from './refusal.ts';
export { type ConnectionGuardEvents, guardConnection } from './werift/guard-connection.ts';
export { WeriftShapeError } from './werift/werift-shape.ts';
