/** The robot's commands besides driving: their buttons, what becomes of them, and the recording. */
import type { CommandBar, CommandEnd, CommandRefusal } from '@farpoint/operator';

const bars = {
  'not-permitted': 'your role does not permit it',
  'not-driver': 'only the driver may',
  estop: 'not while the emergency stop is on',
  moving: 'only while the robot stands still',
} satisfies Record<CommandBar, string>;

export const commands = {
  title: 'Commands',
  otherGroup: 'Other commands',
  recordingGroup: 'Recording',
  /** A button whose next press gives the command. */
  again: (label: string) => `Press again: ${label}`,
  pressAgain: (label: string) => `${label}: press again within 3 s.`,
  /** Beside a command that runs. @param by who gave it */
  runningBy: (by: string) => `running, given by ${by}`,
  running: 'running',
  cancel: 'Cancel',
  cancelTitle: (label: string) => `Cancel: ${label}`,
  /** A command cannot be given now. */
  barred: (label: string, why: string) => `${label}: ${why}.`,
  unsent: (label: string) => `${label}: there is no connection to the robot.`,
  bars,
  refusals: {
    ...bars,
    unknown: 'the robot does not have this command',
    'too-often': 'given too often',
    busy: 'it is still running',
    repeated: 'the robot got it before',
    stale: 'it reached the robot too late',
    'no-text': 'it takes no text',
    'not-cancellable': 'it cannot be cancelled',
  } satisfies Record<CommandRefusal, string>,
  /** What has become of a command. */
  ends: {
    done: 'done',
    failed: 'failed',
    cancelled: 'cancelled',
    refused: 'refused',
    'timed-out': 'no answer in time; it may be done or not',
    'no-answer': 'the robot does not answer; it may be done or not',
    'link-lost': 'the connection was lost; it may be done or not',
  } satisfies Record<CommandEnd['outcome'], string>,
  /** @param end one of the above @param detail what the robot says, or why it refused */
  ended: (label: string, end: string, detail: string | null) =>
    detail === null ? `${label}: ${end}.` : `${label}: ${end} (${detail}).`,
  /** @param time minutes and seconds @param size with its unit */
  recorded: (time: string, size: string) => `Recording ${time}, ${size}`,
  notRecording: 'Not recording',
  bookmarkNote: 'Note for the bookmark (optional)',
  bookmarkTitle: 'Add a bookmark to the recording',
};
