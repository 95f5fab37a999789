import {
  encodeJson,
  type ServiceToOperator,
  type ServiceToRobot,
  serviceToOperatorCodec,
  serviceToRobotCodec,
} from '@farpoint/protocol';
import type { Peer } from './peer.ts';

// Encodes the validated message again. The original text could contain a key twice, and readers disagree on which one
// counts.
export function toRobot(peer: Peer, message: ServiceToRobot): void {
  peer.send(encodeJson(serviceToRobotCodec, message));
}

export function toOperator(peer: Peer, message: ServiceToOperator): void {
  peer.send(encodeJson(serviceToOperatorCodec, message));
}
