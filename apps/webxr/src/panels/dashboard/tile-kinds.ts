/** The tiles that there are: the fixed ones, and a curve for each number that is recorded over time. */
import type { RobotSession } from '@farpoint/operator';
import type { MapTiles } from '../../ground/telemetry/map-tiles.ts';
import { OWN, type TelemetryRecorder } from '../../ground/telemetry/recorder.ts';
import { ChartTile } from './chart-tile.ts';
import { diagnosticsTile } from './diagnostics-tile.ts';
import type { PlacedTile } from './layout.ts';
import { MapTile } from './map-tile.ts';
import type { Tile } from './tile.ts';
import { topicsTile } from './topics-tile.ts';
import { ownValues, valueTile } from './value-tile.ts';

export interface TileKind extends PlacedTile {
  readonly title: string;
  make(): Tile;
}

export interface TileSources {
  readonly recorder: TelemetryRecorder;
  readonly mapTiles: MapTiles | null;
  session(): RobotSession;
}

/** Curves of the robot's state that are shown by default. */
const SHOWN_CURVES: readonly string[] = [OWN.speed.key, OWN.charge.key];
/** Of topics: what a tile or the map shows better, or what says less than another curve. */
const HIDDEN_FIELDS: readonly string[] = ['latitude', 'longitude', 'altitude', 'voltage', 'current'];

/** @returns each as it is by default, in the default order */
export function tileKinds({ recorder, mapTiles, session }: TileSources): TileKind[] {
  const values = ownValues(recorder);
  const value = (id: string, title: string): TileKind => ({
    id,
    title,
    size: 'small',
    shown: true,
    make: () => valueTile(values[id]!),
  });
  const curves = [...recorder.series.values()].map(
    ({ key, label, unit, field }): TileKind => ({
      id: `curve ${key}`,
      title: unit === '' ? label : `${label}, ${unit}`,
      size: 'medium',
      shown: field === null ? SHOWN_CURVES.includes(key) : !HIDDEN_FIELDS.includes(field),
      make: () => new ChartTile(() => recorder.series.get(key)),
    }),
  );
  return [
    value('speed', 'Speed'),
    value('battery', 'Battery'),
    value('heading', 'Heading'),
    value('position', 'Position'),
    { id: 'map', title: 'Map', size: 'large', shown: true, make: () => new MapTile(recorder, mapTiles) },
    {
      id: 'diagnostics',
      title: 'Diagnostics',
      size: 'medium',
      shown: true,
      make: () => diagnosticsTile(session),
    },
    ...curves,
    { id: 'topics', title: 'Topics', size: 'medium', shown: true, make: () => topicsTile(session) },
  ];
}
