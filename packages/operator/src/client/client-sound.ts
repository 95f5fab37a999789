import type { OperatorSessionMessage } from '@farpoint/protocol';
import { RobotSound } from '../sound/robot-sound.ts';
import type { Emitter } from './emitter.ts';
import type { RobotEvents } from './robot-events.ts';

/** The sound of a client, whose events are the client's. */
export function clientSound(
  emitter: Emitter<RobotEvents>,
  send: (message: OperatorSessionMessage) => void,
): RobotSound {
  return new RobotSound({
    send,
    onVoice: (status) => emitter.emit('voice', status),
    onTrack: (track) => emitter.emit('soundTrack', track),
  });
}
