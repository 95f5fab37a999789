/** What is said to the hands, and about who drives. */
import type { DriveInput, GripLoss } from '@farpoint/operator';

export const driving = {
  /** How the grip is held, by device. */
  grip: {
    keyboard: 'Hold Space',
    gamepad: 'Hold a shoulder button',
    touch: 'Hold the joystick',
    headset: 'Squeeze the grip',
    script: 'Hold the grip',
  } satisfies Record<DriveInput['name'], string>,
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
};
