/** The tiles that there are: the fixed ones, and a curve for each number that is recorded over time. */
import type { ReportedComponents, RobotSession } from '@farpoint/operator';
import { diagnosticLevels } from '@farpoint/protocol';
import type { MapTiles } from '../../ground/telemetry/map-tiles.ts';
import {
  OWN,
  type OwnSeries,
  type RecordedSeries,
  type TelemetryRecorder,
} from '../../ground/telemetry/recorder.ts';
import { laterTexts } from '../../words/language.ts';
import { shownReading } from '../../words/shown-readings.ts';
import { ChartTile } from './chart-tile.ts';
import type { PlacedTile } from './layout.ts';
import { MapTile } from './map-tile.ts';
import { ageText } from './number-words.ts';
import { type StageSources, stagesTile } from './stages-tile.ts';
import { part, setText, type Tile } from './tile.ts';
import { ownValues, valueTile } from './value-tile.ts';

/** How often the table is written, ms: twice as often as components report. */
const DIAGNOSTICS_EVERY_MS = 500;
/**
 * After this long without a report of any component, all are stale, ms: five of the robot's repetitions
 * (component-board.ts).
 */
const SILENT_MS = 10_000;
const MOST_SHOWN = 100;

/** The tile with what the robot's components report: counts by level, then each report, the most urgent first. */
function diagnosticsTile(session: () => RobotSession): Tile {
  const element = part('diagnostics');
  const counts = part('counts', 'p');
  const list = document.createElement('ul');
  list.className = 'reports';
  element.append(counts, list);
  return {
    element,
    everyMs: () => DIAGNOSTICS_EVERY_MS,
    update({ moment: { robotNowMs } }) {
      const topics = session().components.list();
      const silentMs = robotNowMs - Math.max(...topics.map(({ timeMs }) => timeMs));
      const isSilent = silentMs > SILENT_MS;
      element.dataset.stale = String(topics.length === 0 || isSilent);
      setText(counts, countWords(topics, isSilent ? silentMs : null));
      const reports = topics.flatMap((topic) => topic.reports).slice(0, MOST_SHOWN);
      while (list.children.length > reports.length) list.lastElementChild?.remove();
      while (list.children.length < reports.length) list.append(row());
      reports.forEach(({ name, level, message, sinceMs }, i) => {
        const item = list.children[i] as HTMLElement;
        item.dataset.level = level;
        const [word, text, age] = [...item.children] as [HTMLElement, HTMLElement, HTMLElement];
        setText(word, laterTexts().dashboard.levels[level]);
        setText(text, message === '' ? name : `${name}: ${message}`);
        setText(age, ageText(Math.max(0, robotNowMs - sinceMs)));
      });
    },
    dispose() {},
  };
}

function countWords(topics: readonly ReportedComponents[], silentMs: number | null): string {
  const said = laterTexts().dashboard;
  if (topics.length === 0) return said.noComponent;
  const words = diagnosticLevels.flatMap((level) => {
    const count = topics.reduce((sum, { counts }) => sum + counts[level], 0);
    return count === 0 ? [] : [`${count} ${said.levels[level]}`];
  });
  const counts = words.join(', ');
  const told = topics.some((topic) => topic.recorded) ? said.recorded(counts) : counts;
  return silentMs === null ? told : said.nothingFor(told, ageText(silentMs));
}

function row(): HTMLElement {
  const item = document.createElement('li');
  item.append(part('level', 'span'), part('report', 'span'), part('age', 'span'));
  return item;
}

/** How often the table of topics is written, ms: as often as people can read. */
const TOPICS_EVERY_MS = 250;

/** The tile with the readings of the robot's topics, as they were at the instant that is shown. */
function topicsTile(session: () => RobotSession): Tile {
  const element = part('topics');
  const nothing = part('nothing', 'p');
  nothing.textContent = laterTexts().dashboard.noTopics;
  const list = document.createElement('dl');
  element.append(nothing, list);
  return {
    element,
    everyMs: () => TOPICS_EVERY_MS,
    update({ nowMs, moment: { instantMs } }) {
      const readings = session()
        .readings.list(nowMs, instantMs ?? Number.POSITIVE_INFINITY)
        .map(shownReading);
      nothing.hidden = readings.length > 0;
      while (list.children.length > 2 * readings.length) list.lastElementChild?.remove();
      while (list.children.length < 2 * readings.length)
        list.append(document.createElement('dt'), document.createElement('dd'));
      readings.forEach(({ label, topic, text, tone }, i) => {
        const [term, value] = [list.children[2 * i], list.children[2 * i + 1]] as [HTMLElement, HTMLElement];
        setText(term, label);
        term.title = topic;
        setText(value, text);
        value.dataset.tone = tone;
      });
    },
    dispose() {},
  };
}

export interface TileKind extends PlacedTile {
  readonly title: string;
  make(): Tile;
}

export interface TileSources extends StageSources {
  readonly recorder: TelemetryRecorder;
  mapTiles(): MapTiles | null;
  session(): RobotSession;
}

/** Curves of the robot's state that are shown by default. */
const SHOWN_CURVES: readonly string[] = [OWN.speed.key, OWN.charge.key];
/** Of topics: what a tile or the map shows better, or what says less than another curve. */
const HIDDEN_FIELDS: readonly string[] = ['latitude', 'longitude', 'altitude', 'voltage', 'current'];

/** By which the line over the picture opens it. */
export const STAGES_TILE = 'stages';

/** The page names what comes with the robot's state; the robot names the rest. */
function seriesTitle({ key, label, unit, recorded }: Omit<RecordedSeries, 'series' | 'field'>): string {
  const { series, recorded: ofRecording } = laterTexts().dashboard;
  const own = (Object.keys(OWN) as OwnSeries[]).find((name) => OWN[name].key === key);
  const name = label ?? (own === undefined ? key : series[own]);
  const shown = recorded === true ? ofRecording(name) : name;
  return unit === '' ? shown : `${shown}, ${unit}`;
}

/** @returns each as it is by default, in the default order */
export function tileKinds(sources: TileSources): TileKind[] {
  const { recorder, mapTiles, session } = sources;
  const values = ownValues(recorder);
  const said = laterTexts().dashboard.tiles;
  const value = (id: 'speed' | 'battery' | 'heading' | 'position'): TileKind => ({
    id,
    title: said[id],
    size: 'small',
    shown: true,
    make: () => valueTile(values[id]!),
  });
  const curves = [...recorder.series.values()].map(
    ({ key, label, unit, field, recorded }): TileKind => ({
      id: `curve ${key}`,
      title: seriesTitle({ key, label, unit, recorded }),
      size: 'medium',
      shown: field === null ? SHOWN_CURVES.includes(key) : !HIDDEN_FIELDS.includes(field),
      make: () => new ChartTile(() => recorder.series.get(key)),
    }),
  );
  return [
    value('speed'),
    value('battery'),
    value('heading'),
    value('position'),
    { id: 'map', title: said.map, size: 'large', shown: true, make: () => new MapTile(recorder, mapTiles) },
    {
      id: 'diagnostics',
      title: said.diagnostics,
      size: 'medium',
      shown: true,
      make: () => diagnosticsTile(session),
    },
    ...curves,
    {
      id: STAGES_TILE,
      title: said.stages,
      size: 'medium',
      shown: false,
      make: () => stagesTile(sources),
    },
    { id: 'topics', title: said.topics, size: 'medium', shown: true, make: () => topicsTile(session) },
  ];
}
