import { bridgeAttacks } from './attacks/bridge.ts';
import { dtlsAttacks } from './attacks/dtls.ts';
import { fileAttacks } from './attacks/files.ts';
import { grantAttacks } from './attacks/grants.ts';
import { httpAttacks } from './attacks/http.ts';
import { iceAttacks } from './attacks/ice.ts';
import { peerMediaAttacks } from './attacks/peer-media.ts';
import { peerPathAttacks } from './attacks/peer-path.ts';
import { peerSctpAttacks } from './attacks/peer-sctp.ts';
import { peopleAttacks } from './attacks/people.ts';
import { referenceAttacks } from './attacks/reference.ts';
import { robotCommandAttacks } from './attacks/robot-commands.ts';
import { sctpAttacks } from './attacks/sctp.ts';
import { sessionAttacks } from './attacks/session.ts';
import { signalingAttacks } from './attacks/signaling.ts';
import { srtpAttacks } from './attacks/srtp.ts';

export const allAttacks = [
  ...dtlsAttacks,
  ...iceAttacks,
  ...srtpAttacks,
  ...sctpAttacks,
  ...peerSctpAttacks,
  ...peerMediaAttacks,
  ...peerPathAttacks,
  ...sessionAttacks,
  ...peopleAttacks,
  ...robotCommandAttacks,
  ...grantAttacks,
  ...signalingAttacks,
  ...referenceAttacks,
  ...httpAttacks,
  ...bridgeAttacks,
  ...fileAttacks,
];
