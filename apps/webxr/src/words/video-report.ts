/** What the compositor did with the videos, for people. */
import type { ItemDropReason, SourceState } from '@farpoint/operator';
import { CLOUD, type VideoStats } from '../take/video/video-figures.ts';
import type { Tone } from './words.ts';

export interface VideoReportLine {
  readonly name: string;
  readonly text: string;
  readonly tone: Tone;
}

export interface VideoReport {
  /** In a few words: whether what is shown was captured together. */
  readonly summary: string;
  readonly tone: Tone;
  readonly lines: readonly VideoReportLine[];
}

const stateWords: Record<SourceState, string> = {
  'in-step': 'in step',
  apart: 'by itself',
  silent: 'silent',
};
const dropWords: Record<ItemDropReason, string> = {
  superseded: 'replaced by a newer one',
  late: 'too late',
  overflow: 'too many waiting',
  removed: 'switched off',
};
/** Videos that differ by no more look as if they moved together, ms: half a frame at 30 a second. */
const IN_STEP_MS = 17;

/** @param names of the videos, by number */
export function videoReport(videos: VideoStats, names: readonly string[]): VideoReport {
  const { synchronised, spreadMs, sources } = videos;
  const lines = sources.map(({ source, state, waits, presented, drops }): VideoReportLine => {
    const parts = [synchronised ? stateWords[state] : state === 'silent' ? 'silent' : 'as it comes'];
    if (waits > 0) parts.push(`waited for in vain ${times(waits, presented)}`);
    // A cloud's points are drawn as they come: what the compositor drops of it is only its time.
    const isHeld = source !== CLOUD;
    for (const reason of Object.keys(dropWords) as ItemDropReason[])
      if (isHeld && drops[reason] > 0) parts.push(`${drops[reason]} ${dropWords[reason]}`);
    return {
      name: nameOf(source, names),
      text: parts.join(' · '),
      tone: state === 'silent' ? 'warning' : 'neutral',
    };
  });
  for (const [reason, count] of Object.entries(videos.undecoded))
    if (count > 0)
      lines.push({ name: 'Not decoded', text: `${count} ${reason.replaceAll('-', ' ')}`, tone: 'neutral' });
  if (videos.undated > 0)
    lines.push({ name: 'Without a time', text: String(videos.undated), tone: 'warning' });
  if (!synchronised) return { summary: 'Not in step', tone: 'neutral', lines };
  const coming = sources.filter(({ source, state }) => source !== CLOUD && state !== 'silent').length;
  if (coming === 0) return { summary: 'No video comes', tone: 'warning', lines };
  if (coming === 1 || spreadMs === null) return { summary: 'One video', tone: 'neutral', lines };
  const apart = Math.round(spreadMs.p95);
  return {
    summary: `In step within ${apart} ms`,
    tone: apart > IN_STEP_MS ? 'warning' : 'neutral',
    lines,
  };
}

function times(count: number, of: number): string {
  const share = of > 0 ? ` (${((100 * count) / of).toFixed(1)} %)` : '';
  return `${count}×${share}`;
}

function nameOf(source: string, names: readonly string[]): string {
  const video = /^video:(\d+)$/.exec(source)?.[1];
  return video === undefined ? 'Cloud' : (names[Number(video)] ?? source);
}
