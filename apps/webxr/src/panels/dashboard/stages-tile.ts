/** The tile with where the time goes: each cloud of the last 30 s as a column of its stages, and the figures of each stage. */
import './stages-tile.css';
import {
  commandStages,
  type FrameStage,
  frameStages,
  STAGES_KEPT_MS,
  type StageRow,
  type StageSummary,
  type StreamStatistics,
} from '@farpoint/operator';
import { palette } from '../../ground/display/palette.ts';
import { texts } from '../../words/language.ts';
import { stageLines, stagesCsv, totalWords, unknownWords } from '../../words/stage-words.ts';
import { quietButton } from '../ui/panel-parts.ts';
import { saveTable } from '../ui/save-file.ts';
import type { LatencyRunsPort } from './latency-runs.ts';
import { latencyView } from './latency-view.ts';
import { part, setText, type Tile } from './tile.ts';

/** What the tile shows, and what it measures. */
export interface StageSources {
  stages(): Pick<StreamStatistics, 'frameStages' | 'commands'>;
  testLatency: LatencyRunsPort['test'];
}

/** How often the tile is written, ms: as often as the robot tells its times. */
const UPDATE_MS = 250;
/** By stage, in their order. Chosen: apart from each other also for the colour-blind (Okabe and Ito). */
const COLOURS = ['#e69f00', '#56b4e9', '#009e73', '#f0e442', '#d55e00', '#cc79a7'] as const;
/** Of a picture of the last 30 s, pixels of the canvas. */
const [WIDTH, HEIGHT] = [600, 144];

export function stagesTile({ stages: source, testLatency }: StageSources): Tile {
  const element = part('where-time');
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [WIDTH, HEIGHT];
  canvas.ariaHidden = 'true';
  const latency = latencyView(testLatency);
  const said = texts().timing;
  const clouds = new StageList(said.frameStages);
  const commands = new StageList(said.commandStages);
  const rowsOf = (nowMs: number) => source().frameStages()?.window.rows(nowMs) ?? [];
  const saveClouds = quietButton(said.cloudsAsCsv, said.cloudsAsCsvTitle, () =>
    saveTable('clouds', stagesCsv(frameStages, rowsOf(performance.now()), performance.timeOrigin)),
  );
  const saveCommands = quietButton(said.commandsAsCsv, said.commandsAsCsvTitle, () => {
    const rows = source().commands.window.rows(performance.now());
    saveTable('commands', stagesCsv(commandStages, rows, performance.timeOrigin));
  });
  element.append(canvas, clouds.element, saveClouds, commands.element, saveCommands, latency.element);
  return {
    element,
    everyMs: () => UPDATE_MS,
    update({ nowMs }) {
      const summary = source().frameStages()?.window.summary(nowMs) ?? null;
      element.dataset.stale = String(summary === null || summary.rows === 0);
      clouds.show(said.clouds, summary);
      commands.show(said.commands, source().commands.window.summary(nowMs));
      drawRows(canvas, rowsOf(nowMs), nowMs);
    },
    dispose: () => latency.dispose(),
  };
}

/** A line with the total, and one for each stage. */
class StageList<Stage extends string> {
  readonly element = part('stages');
  readonly #names: Readonly<Record<Stage, string>>;
  readonly #total = part('total', 'p');
  readonly #list = document.createElement('ul');
  readonly #unknown = part('unknown', 'p');

  constructor(names: Readonly<Record<Stage, string>>) {
    this.#names = names;
    this.#list.append(...Object.keys(names).map((_, i) => stageItem(COLOURS[i] ?? '')));
    this.element.append(this.#total, this.#list, this.#unknown);
  }

  show(what: string, summary: StageSummary<Stage> | null): void {
    setText(this.#total, totalWords(what, summary?.totalMs ?? null));
    setText(this.#unknown, summary === null ? '' : unknownWords(summary));
    this.#list.hidden = summary === null;
    if (summary === null) return;
    stageLines(summary, this.#names).forEach(({ name, median, p95, isWorst }, i) => {
      const item = this.#list.children[i] as HTMLElement;
      const [, shownName, shownMedian, shownP95] = [...item.children] as HTMLElement[];
      item.dataset.worst = String(isWorst);
      setText(shownName as HTMLElement, name);
      setText(shownMedian as HTMLElement, median);
      setText(shownP95 as HTMLElement, p95);
    });
  }
}

function stageItem(colour: string): HTMLElement {
  const item = document.createElement('li');
  const mark = part('mark', 'span');
  mark.style.background = colour;
  const [name, median, p95] = [part('name', 'span'), part('median', 'output'), part('p95', 'output')];
  // Read aloud on request only.
  for (const output of [median, p95]) output.ariaLive = 'off';
  median.title = texts().timing.median;
  p95.title = texts().timing.p95;
  item.append(mark, name, median, p95);
  return item;
}

/** A column for each frame, of its stages one above the other; grey up to the total where they are unknown. */
function drawRows(canvas: HTMLCanvasElement, rows: readonly StageRow<FrameStage>[], nowMs: number): void {
  const context = canvas.getContext('2d');
  if (context === null) return;
  context.clearRect(0, 0, WIDTH, HEIGHT);
  const most = rows.reduce((highest, { totalMs }) => Math.max(highest, totalMs ?? 0), 0);
  if (most === 0) return;
  for (const { endedMs, totalMs, stages } of rows) {
    const x = WIDTH * (1 - (nowMs - endedMs) / STAGES_KEPT_MS);
    const heightOf = (value: number | null) => (HEIGHT * Math.max(0, value ?? 0)) / most;
    context.fillStyle = palette.quiet;
    context.fillRect(x, HEIGHT - heightOf(totalMs), 1, heightOf(totalMs));
    if (stages.link === null) continue;
    let bottom = HEIGHT;
    frameStages.forEach((stage, i) => {
      const height = heightOf(stages[stage]);
      context.fillStyle = COLOURS[i] ?? '';
      context.fillRect(x, bottom - height, 1, height);
      bottom -= height;
    });
  }
}
