export { type Unproven, UnprovenPeerError } from './dtls/peer-proof.ts';
export { type CandidateRefusal, candidateRefusals } from './ice/candidate-gate.ts';
export { type Refusal, Refusals } from './refusal.ts';
export { type ConnectionGuardEvents, guardConnection } from './werift/guard-connection.ts';
export { prepareSockets } from './werift/ice-sockets.ts';
export { RemoteCandidates } from './werift/remote-candidates.ts';
export { WeriftShapeError } from './werift/werift-shape.ts';
