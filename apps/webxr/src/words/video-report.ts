/** What the compositor did with the videos, for people. */
import type { ItemDropReason } from '@farpoint/operator';
import { CLOUD, type VideoStats } from '../take/video/video-figures.ts';
import { texts } from './language.ts';
import { fixed } from './numbers.ts';
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

/** Videos that differ by no more look as if they moved together, ms: half a frame at 30 a second. */
const IN_STEP_MS = 17;

/** @param names of the videos, by number */
export function videoReport(videos: VideoStats, names: readonly string[]): VideoReport {
  const { synchronised, spreadMs, sources } = videos;
  const said = texts().media.report;
  const lines = sources.map(({ source, state, waits, presented, drops }): VideoReportLine => {
    const parts = [synchronised || state === 'silent' ? said.states[state] : said.asItComes];
    if (waits > 0) parts.push(said.inVain(times(waits, presented)));
    // A cloud's points are drawn as they come: what the compositor drops of it is only its time.
    const isHeld = source !== CLOUD;
    for (const reason of Object.keys(said.drops) as ItemDropReason[])
      if (isHeld && drops[reason] > 0) parts.push(`${drops[reason]} ${said.drops[reason]}`);
    return {
      name: nameOf(source, names),
      text: parts.join(' · '),
      tone: state === 'silent' ? 'warning' : 'neutral',
    };
  });
  for (const [reason, count] of Object.entries(videos.undecoded))
    if (count > 0)
      lines.push({ name: said.notDecoded, text: `${count} ${undecodedWords(reason)}`, tone: 'neutral' });
  if (videos.undated > 0)
    lines.push({ name: said.withoutTime, text: String(videos.undated), tone: 'warning' });
  if (!synchronised) return { summary: said.notInStep, tone: 'neutral', lines };
  const coming = sources.filter(({ source, state }) => source !== CLOUD && state !== 'silent').length;
  if (coming === 0) return { summary: said.noVideo, tone: 'warning', lines };
  if (coming === 1 || spreadMs === null) return { summary: said.oneVideo, tone: 'neutral', lines };
  const apart = Math.round(spreadMs.p95);
  return {
    summary: said.inStepWithin(apart),
    tone: apart > IN_STEP_MS ? 'warning' : 'neutral',
    lines,
  };
}

/** A browser may know reasons that this page does not. */
function undecodedWords(reason: string): string {
  const known: Readonly<Record<string, string>> = texts().media.report.undecoded;
  return known[reason] ?? reason.replaceAll('-', ' ');
}

function times(count: number, of: number): string {
  const share = of > 0 ? ` (${fixed((100 * count) / of, 1)} %)` : '';
  return `${count}×${share}`;
}

function nameOf(source: string, names: readonly string[]): string {
  const video = /^video:(\d+)$/.exec(source)?.[1];
  return video === undefined ? texts().media.report.cloud : (names[Number(video)] ?? source);
}
