import { ProtocolError } from './errors.ts';

/** Text messages with which an operator starts and pauses the robot's stream of points. */
export type StreamSwitch = 'start' | 'stop';

/** @throws {ProtocolError} for any other text */
export function decodeStreamSwitch(text: string): StreamSwitch {
  if (text === 'start' || text === 'stop') return text;
  throw new ProtocolError('invalid', 'stream switch', '', "neither 'start' nor 'stop'");
}
