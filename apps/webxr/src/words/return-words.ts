/** What a robot says that drives back by itself, for people. */
import type { ReturnEnd, ReturnState } from '@farpoint/protocol';
import type { Words } from './words.ts';

const ends: Readonly<Record<ReturnEnd, string>> = {
  'service-back': 'until somebody was heard again',
  estop: 'until the emergency stop',
  'track-end': 'to the beginning of its track',
  moved: 'something else moved it',
  'no-track': 'it knew no way',
  'off-track': 'until it was off its track',
  'odometry-silent': 'until it did not know where it was',
  'sensor-silent': 'until a sensor gave nothing',
  unseen: 'until no sensor saw the way',
  blocked: 'until something was in the way',
  'no-wheels': 'until nothing took its velocities',
  'too-long': 'until its time was up',
};

/** Why the robot is not where its driver has left it. */
export function returnWords({ phase, metres, end }: ReturnState): Words {
  if (phase === 'announcing')
    return { text: 'The link was lost: the robot is about to drive back', tone: 'warning' };
  if (phase === 'returning')
    return { text: 'The link was lost: the robot drives back along its track', tone: 'warning' };
  const why = end === undefined ? '' : `: ${ends[end]}`;
  const way =
    metres < 0.05
      ? 'The link was lost; the robot stayed'
      : `The link was lost; it came back ${metres.toFixed(1)} m`;
  return { text: way + why, tone: 'warning' };
}
