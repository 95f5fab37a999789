/** What is said in the table of figures, of readings and alarms, and of what must be known before a robot is used. */
import type { PictureUse } from '@farpoint/cloud-view';
import type { VideoColourState } from '../../take/video/video-colour.ts';

export const figures = {
  fold: 'Figures',
  names: {
    robot: 'Robot',
    view: 'View',
    operators: 'Operators',
    state: 'State',
    speed: 'Speed',
    speedLimit: 'Speed limit',
    battery: 'Battery',
    points: 'Points',
    drawn: 'Drawn',
    remembered: 'Remembered',
    colours: 'Colours',
    rate: 'Rate',
    loss: 'Loss',
    roundTrip: 'Round trip',
    viewAge: 'View age',
    motionToPhoton: 'Motion to photon',
  },
  sideways: (metresPerSecond: string, toLeft: boolean) =>
    `${metresPerSecond} m/s to the ${toLeft ? 'left' : 'right'}`,
  stoppedBy: (state: string, who: string) => `${state} (by ${who})`,
  stoppedAtRobot: (state: string, who: string) => `${state} (by ${who}; released at the robot only)`,
  stoppers: { operator: 'operator', robot: 'robot' },
  chargeUnknown: 'charge unknown',
  drawnOf: (drawn: string, came: string) => `${drawn} of ${came}: this computer is slow`,
  p95: (median: string, p95: string) => `${median}  p95 ${p95}`,
  /** Whether the surface has the colours of its camera's video, and if not, why. */
  colours: {
    painted: 'from the video',
    partly: (share: string) => `from the video for ${share}`,
    'switched-off': 'the points’ own',
    'not-in-step': 'the points’ own: video and points are not in step',
    'not-watched': 'the points’ own: the video is off',
    'no-picture': 'the points’ own: no video comes',
    late: 'the points’ own: the video comes too late',
    noMatch: (why: string) => `the points’ own: ${why}`,
  } satisfies Partial<Record<VideoColourState, string>> & Record<string, unknown>,
  misfits: {
    'other-shape': 'the video’s shape is another',
    'too-large': 'the video is too large',
    unreadable: 'this browser cannot paint with the video',
    other: 'no picture was captured with them',
  } satisfies Partial<Record<PictureUse, string>> & { other: string },
  /** A reading. */
  ago: (text: string, seconds: number) => `${text} (${seconds} s ago)`,
  /** An alarm, by the robot's text. */
  alarm: (text: string, value: string, limit: string) => `${text} (${value}, limit ${limit})`,
  alarmAgo: (alarm: string, seconds: number) => `${alarm}, ${seconds} s ago`,
  recorded: (alarm: string) => `Recorded: ${alarm}`,
  andMore: (alarm: string, others: number) => `${alarm} (and ${others} more)`,
  isPlayback: 'Playback: nothing that you see is there now',
  isRecorded: 'This session is being recorded',
};
