/** What reads bytes of strangers, for those who test it. */
export { splitClientHello } from './dtls/client-hello.ts';
export { type DtlsEndpoint, DtlsGate } from './dtls/dtls-gate.ts';
export { HandshakeAssembler } from './dtls/handshake-assembler.ts';
export { parseHandshakeFragments, serializeHandshake } from './dtls/handshake-message.ts';
export { parseRecords } from './dtls/record.ts';
export { CandidateGate, takeCandidates } from './ice/candidate-gate.ts';
export { Refusals } from './refusal.ts';
export { compoundWork, leadingReport } from './rtcp/compound-work.ts';
export { isSctpPacket } from './sctp/packet-check.ts';
export { sctpWork } from './sctp/packet-work.ts';
export { isUserMessage } from './sctp/user-message-check.ts';
export { isAuthenticRequest, stunKind } from './stun/binding-request.ts';
