/** Why the robot did not do what an operator asked of another. */
import type { FaultReason } from '@farpoint/protocol';

export const peopleFaultWords: Partial<Record<FaultReason, string>> = {
  'not-permitted': 'your grant lets you watch this robot, not drive it',
  'unknown-operator': 'this operator is not here, or cannot be asked',
  'own-session': 'you drive already',
  'rate-limited': 'you have just been refused: wait a moment before you ask again',
  'not-driver': 'only the operator who drives offers the drive',
  'nobody-drives': 'nobody drives: take the drive by holding the grip',
  'only-watches': 'this operator may only watch',
  'already-open': 'your last request or offer has not been answered yet',
  'not-open': 'this request or offer can no longer be answered',
  estop: 'the drive is not handed over while the emergency stop is on',
};
