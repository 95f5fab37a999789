/** What is said about the emergency stop: who pressed it and why it is on, and who may release it. */
import type { EstopCause } from '@farpoint/protocol';

export const stop = {
  title: 'Emergency stop',
  /** Under the STOP button. */
  button: { latched: 'engaged', clear: 'emergency' },
  hold: 'Hold the release control for one second; then let go of the grip and drive.',
  unheard: 'So the robot said before it fell silent. It can be released when the robot is heard again.',
  /** What on the robot holds it. */
  holders: {
    topic: 'a program on it',
    shm: 'a program on it',
    gpio: 'its own stop button',
    key: 'a key at its own keyboard',
  } satisfies Record<NonNullable<EstopCause['heldBy']>[number], string>,
  /** The robot has started with it. */
  starts: {
    'was-latched': 'The stop was on when the robot was last shut down.',
    'unclean-exit': 'The robot’s program did not shut down in order: it crashed, or lost its power.',
    unreadable: 'The robot cannot read whether a stop was on when it last ran.',
    unwritable: 'The robot cannot store its emergency stop, so it starts stopped.',
  } satisfies Record<NonNullable<EstopCause['start']>, string>,
  heldBy: (holders: readonly string[]) => `The robot is stopped by ${holders.join(' and ')}.`,
  heldAtRobot: 'The robot is stopped by a stop on the robot itself.',
  byYou: 'You pressed STOP.',
  by: (name: string) => `${name} pressed STOP.`,
  byRobot: 'The robot has stopped itself.',
  byOperator: 'An operator pressed STOP.',
  releasedThere: 'It is released there, at the robot, and nowhere else.',
  supervisorReleases: 'Only a supervisor releases it.',
  youWatch: 'Your grant lets you watch: whoever drives releases it.',
  whoeverPressed: 'Whoever pressed STOP',
  presserReleases: (name: string) => `${name}, or a supervisor, releases it.`,
  whoeverDrives: 'Whoever drives',
  driverReleases: (name: string) => `${name} releases it. To do it yourself, take over first.`,
  /** Told once. */
  anotherOperator: 'Another operator',
  hasPressed: (name: string) => `${name} has pressed STOP.`,
  hasReleased: (name: string) => `${name} has released the emergency stop.`,
  releasedAtRobot: 'The emergency stop has been released at the robot.',
};
