/** What becomes of the robot's goal, for people. */
import type { GoalEnd, GoalStatus } from '@farpoint/operator';
import type { Words } from '../status/tone.ts';

const ends: Readonly<Record<GoalEnd, string>> = {
  off: 'the robot takes no goals',
  'not-permitted': 'your grant does not let you drive',
  'not-lease-holder': 'you do not drive',
  repeated: 'the robot had it before',
  stale: 'it came too late',
  'rate-limited': 'too many goals',
  'too-far': 'it is too far away',
  'outside-fence': 'the robot may not go there',
  estop: 'the emergency stop is on',
  'no-wheels': 'nothing takes the robot’s velocities',
  'no-pose': 'the robot does not know where it is',
  asked: 'you took it back',
  replaced: 'there is another goal',
  stick: 'you took the stick',
  silence: 'the robot did not hear you',
  'lease-lost': 'you no longer drive',
  'navigator-silent': 'the navigator gives no velocities',
  'pose-jump': 'the robot’s pose has jumped',
  obstacle: 'something is in the way',
  fence: 'the edge of the permitted area',
  view: 'what you saw was too old',
  'no-progress': 'the robot gets nowhere',
  hidden: 'you looked elsewhere',
  'link-lost': 'the link was lost',
  'other-drives': 'somebody else is driving',
  'no-answer': 'the robot does not answer',
};

export const armedWords: Words = { text: 'Click on the floor', tone: 'neutral' };

export function goalWords({ state, reason }: GoalStatus): Words {
  const why = reason === null ? '' : ends[reason];
  switch (state) {
    case 'asked':
      return { text: 'Asks the robot to go there', tone: 'neutral' };
    case 'accepted':
      return { text: 'The robot looks for a way', tone: 'neutral' };
    case 'driving':
      return { text: 'Going', tone: 'neutral' };
    case 'reached':
      return { text: 'Arrived', tone: 'good' };
    case 'refused':
      return { text: `Not going: ${why}`, tone: 'warning' };
    case 'cancelled':
      return { text: `Cancelled: ${why}`, tone: 'warning' };
    case 'blocked':
      return { text: `Stopped: ${why}`, tone: 'bad' };
  }
}

/** How far it is, behind the words; nothing once it no longer matters. @param metres `null` while that is not known */
export function distanceWords({ state }: GoalStatus, metres: number | null): string {
  return state !== 'driving' || metres === null ? '' : `, ${metres.toFixed(1)} m`;
}
