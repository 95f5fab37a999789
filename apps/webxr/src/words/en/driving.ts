/** What is said to the hands, and about who drives. */
import type { DriveInput, GripLoss, StopStatus } from '@farpoint/operator';
import type { CommandRejection, DriveState } from '@farpoint/protocol';

export const driving = {
  /** How the grip is held, by device. */
  grip: {
    keyboard: 'Hold the grip key',
    gamepad: 'Hold a shoulder button, or the grip that you chose',
    touch: 'Hold the joystick',
    headset: 'Squeeze the grip',
    script: 'Hold the grip',
  } satisfies Record<DriveInput['name'], string>,
  /** @param key its name */
  holdKey: (key: string) => `Hold ${key}`,
  /** @param grip how it is held */
  gripMissing: (grip: string) => `${grip}, too: the robot moves only while you do.`,
  anotherOperator: 'Another operator',
  takenOver: (driver: string) => `${driver} has taken over and drives now. You do not.`,
  takenOverTitle: 'Taken over',
  letGo: 'Let go of the grip.',
  letGoTitle: 'Let go of the grip',
  /** Why a grip that is held does not drive. */
  gripLost: {
    'late-reading': 'The grip was not read for too long, so the robot stays. Let go of it, then drive.',
    'hands-away': 'The page or the headset was left with the grip held. Let go of it, then drive.',
    'path-lost': 'The connection was lost while you held the grip. Let go of it, then drive.',
    'other-drives': 'Somebody else drove while you held the grip. Let go of it, then drive.',
    'let-go': 'The robot was let go of. Let go of the grip, too, before you drive again.',
  } satisfies Record<GripLoss, string>,
  devices: {
    keyboard: 'keyboard',
    gamepad: 'gamepad',
    touch: 'touch',
    headset: 'headset',
    script: 'script',
  } satisfies Record<DriveInput['name'], string>,
  /** What the robot does. */
  states: {
    driving: 'Driving',
    idle: 'Stationary',
    watchdog: 'Stopped: no recent command',
    estop: 'Emergency stop',
    blocked: 'Blocked by an obstacle',
  } satisfies Record<DriveState, string>,
  stoppedByGap: 'Stopped by a gap: let go, then drive',
  /** Why the robot did not take a command. */
  rejections: {
    malformed: 'The robot could not read a command.',
    'out-of-range': 'The robot refused a speed above its limits.',
    stale: 'Commands reach the robot too late. It stays stopped until the connection improves.',
    repeated: 'The robot refused a command that arrived out of order.',
    'not-permitted': 'Your grant lets you watch this robot, but not drive it.',
    'not-lease-holder': 'Someone else is driving this robot. To drive it yourself, choose Take over.',
    'dead-man-released': 'The robot moves only while you hold the grip.',
    'let-go-first': 'The robot was stopped while you held the grip. Let go of it, then drive.',
    'no-wheels': 'The robot’s wheels take no commands. The reading “Wheels” says why.',
    'estop-latched': 'The emergency stop is on. Release it, let go of the grip, then drive.',
    'rate-limited': 'The robot receives more commands than it accepts.',
  } satisfies Record<CommandRejection, string>,
  turnEnded:
    'Your turn to drive has ended: the robot had not heard from you. Let go of the grip, then drive.',
  /** What has become of STOP. */
  stop: {
    unconfirmed: 'STOP not yet confirmed',
    confirmed: 'STOP confirmed',
    undelivered: 'STOP never arrived',
  } satisfies Record<Exclude<StopStatus, 'none'>, string>,
  /** Who drives. */
  holder: {
    unheard: 'The robot does not hear you',
    someoneElse: 'Someone else',
    otherDrives: (name: string) => `${name} is driving`,
    stopIsOn: 'STOP is on: let go, release it, then drive',
    nobodyYouWatch: 'Nobody is driving. Your grant lets you watch',
    letGo: 'Let go of the grip, then drive',
    paused: 'Hold on: your grip was not read for a moment',
    nobody: 'Nobody is driving',
    youHaveControl: 'You have control',
    youDrive: (device: string) => `You are driving (${device})`,
    withoutWheels: 'Nothing to drive: this robot has no wheels',
  },
  /** Shown when another robot has been chosen. */
  leaving: 'Stopping this robot first…',
  noOtherRobot: 'No other robot is available.',
};
