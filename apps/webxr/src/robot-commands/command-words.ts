/** What the robot's commands are called, and what becomes of them, for people. */
import type { CommandBar, CommandRefusal, CommandResult } from '@farpoint/operator';
import type { Words } from '../status/tone.ts';

const refusals: Readonly<Record<CommandRefusal, string>> = {
  'not-permitted': 'your grant does not let you drive',
  'not-driver': 'only who drives may',
  estop: 'not while the emergency stop is on',
  unknown: 'the robot does not have it',
  'too-often': 'too often',
  busy: 'it has not ended yet',
  stale: 'it came too late',
};

/** Why a command cannot be given now. */
export function barWords(bar: CommandBar): string {
  return refusals[bar];
}

/** What is on a command's button. */
export function buttonWords(label: string, { armed, waiting }: { armed: boolean; waiting: boolean }): string {
  if (waiting) return `${label} …`;
  return armed ? `Press again: ${label}` : label;
}

export function armedWords(label: string): Words {
  return { text: `${label}: press again within 3 s`, tone: 'neutral' };
}

export function barredWords(label: string, bar: CommandBar): Words {
  return { text: `${label}: ${refusals[bar]}`, tone: 'warning' };
}

export function unsentWords(label: string): Words {
  return { text: `${label}: there is no link to the robot`, tone: 'warning' };
}

export function resultWords({ label, outcome, reason, detail }: CommandResult): Words {
  const said = detail === null ? '' : `: ${detail}`;
  switch (outcome) {
    case 'done':
      return { text: `${label}${said === '' ? ': done' : said}`, tone: 'good' };
    case 'refused':
      return {
        text: `${label} was refused${reason === null ? '' : `: ${refusals[reason]}`}`,
        tone: 'warning',
      };
    case 'failed':
      return { text: `${label} failed${said}`, tone: 'bad' };
    case 'timed-out':
      return { text: `${label}: nothing has answered. It may be done or not.`, tone: 'warning' };
    case 'no-answer':
      return { text: `${label}: the robot does not answer. It may be done or not.`, tone: 'warning' };
    case 'link-lost':
      return { text: `${label}: the link was lost. It may be done or not.`, tone: 'warning' };
  }
}
