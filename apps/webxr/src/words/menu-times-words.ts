/** Where the time goes, as lines of the headset's menu. */
import type { CommandStage, FrameStage, StageSummary } from '@farpoint/operator';
import { laterTexts, texts } from './language.ts';
import { stageLines, totalWords, unknownWords } from './stage-words.ts';
import type { Words } from './words.ts';

/** @param clouds `null`: none have come */
export function menuTimes(
  clouds: StageSummary<FrameStage> | null,
  commands: StageSummary<CommandStage>,
): { clouds: Words[]; commands: Words[] } {
  const { timing } = texts();
  const { headsetMenu: said } = laterTexts();
  return {
    clouds: linesOf(said.clouds, clouds, timing.frameStages),
    commands: linesOf(said.commands, commands, timing.commandStages),
  };
}

function linesOf<Stage extends string>(
  what: string,
  summary: StageSummary<Stage> | null,
  names: Readonly<Record<Stage, string>>,
): Words[] {
  const total: Words = { text: totalWords(what, summary?.totalMs ?? null), tone: 'good' };
  if (summary === null) return [total];
  const unknown = unknownWords(summary);
  return [
    total,
    ...stageLines(summary, names).map(
      ({ name, median, p95, isWorst }): Words => ({
        text: laterTexts().headsetMenu.stage(name, median, p95),
        tone: isWorst ? 'warning' : 'neutral',
      }),
    ),
    ...(unknown === '' ? [] : [{ text: unknown, tone: 'neutral' } as const]),
  ];
}
