/** What the robot's commands and its recording are called, and what becomes of them. */
import type { CommandBar, CommandEnd, CommandRunning } from '@farpoint/operator';
import type { RecordingState } from '@farpoint/protocol';
import { texts } from './language.ts';
import type { Tone, Words } from './words.ts';

/** What stands below a command's label: what it does, or why it cannot be given; empty if there is nothing to say. */
export function commandNote(bar: CommandBar | null, running: CommandRunning | null): string {
  const said = texts().commands;
  if (running === null) return bar === null ? '' : said.bars[bar];
  const { by, detail } = running;
  const who = by === null ? said.running : said.runningBy(by);
  return detail === null ? who : `${detail} (${who})`;
}

export function barredWords(label: string, bar: CommandBar): Words {
  const { barred, bars } = texts().commands;
  return { text: barred(label, bars[bar]), tone: 'warning' };
}

const TONES: Readonly<Record<CommandEnd['outcome'], Tone>> = {
  done: 'good',
  failed: 'bad',
  cancelled: 'neutral',
  refused: 'warning',
  'timed-out': 'warning',
  'no-answer': 'warning',
  'link-lost': 'warning',
};

/** What has become of a command of this operator. */
export function endWords({ label, outcome, reason, detail }: CommandEnd): Words {
  const { ends, ended, refusals } = texts().commands;
  const why = reason === null ? detail : refusals[reason];
  return { text: ended(label, ends[outcome], why), tone: TONES[outcome] };
}

/** How long the robot has recorded, and how much. @param recording `null`: it does not */
export function recordingLine(recording: RecordingState | null): string {
  const { recorded, notRecording } = texts().commands;
  if (recording === null) return notRecording;
  const { forS, bytes } = recording;
  const seconds = String(forS % 60).padStart(2, '0');
  return recorded(`${Math.floor(forS / 60)}:${seconds}`, `${Math.round(bytes / 1e6)} MB`);
}
