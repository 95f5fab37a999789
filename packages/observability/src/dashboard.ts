/** A dashboard in Grafana's JSON model, from rows of panels. */

/** How Grafana writes values. */
export type Unit =
  | 'short'
  | 's'
  | 'bps'
  | 'Bps'
  | 'percentunit'
  | 'ops'
  | 'cps'
  | 'bool_yes_no'
  | 'bytes'
  | 'lengthm';

export interface Query {
  /** PromQL; `$robot` stands for the chosen robots' `instance`. */
  readonly expr: string;
  /** Of each series; `{{label}}` stands for a label's value. */
  readonly legend: string;
}

export interface Panel {
  readonly title: string;
  /** What it shows, and what a reader does about it. */
  readonly about: string;
  readonly unit: Unit;
  readonly queries: readonly Query[];
  /** From this value on, the value is marked as bad. */
  readonly badFrom?: number;
}

export interface Dashboard {
  /** Part of its address in Grafana; must not change. */
  readonly uid: string;
  readonly title: string;
  readonly about: string;
  /** A metric whose instances the reader chooses from. */
  readonly instancesOf: string;
  readonly rows: readonly { readonly title: string; readonly panels: readonly Panel[] }[];
}

const COLUMNS = 24;
const PANELS_PER_ROW = 3;
const PANEL_HEIGHT = 8;
/** Of Grafana 10 and later; older ones are migrated when they are loaded. */
const SCHEMA_VERSION = 39;

/** @returns plain data: the JSON that Grafana imports */
export function grafanaDashboard({ uid, title, about, instancesOf, rows }: Dashboard): object {
  const panels: object[] = [];
  let y = 0;
  for (const row of rows) {
    panels.push({
      ...{ id: panels.length + 1, type: 'row', title: row.title, collapsed: false, panels: [] },
      gridPos: { x: 0, y: y++, w: COLUMNS, h: 1 },
    });
    row.panels.forEach((panel, index) => {
      const w = COLUMNS / PANELS_PER_ROW;
      const x = (index % PANELS_PER_ROW) * w;
      const down = Math.floor(index / PANELS_PER_ROW) * PANEL_HEIGHT;
      panels.push(timeSeries(panel, panels.length + 1, { x, y: y + down, w, h: PANEL_HEIGHT }));
    });
    y += Math.ceil(row.panels.length / PANELS_PER_ROW) * PANEL_HEIGHT;
  }
  return {
    ...{ uid, title, description: about, tags: ['farpoint'], schemaVersion: SCHEMA_VERSION, editable: true },
    ...{ refresh: '10s', time: { from: 'now-30m', to: 'now' }, timezone: 'browser', graphTooltip: 1 },
    templating: { list: [dataSource, instances(instancesOf)] },
    panels,
  };
}

const dataSource = {
  ...{ name: 'source', label: 'Prometheus', type: 'datasource', query: 'prometheus', current: {} },
};

function instances(metric: string): object {
  return {
    ...{ name: 'robot', label: 'Instance', type: 'query', multi: true, includeAll: true, allValue: '.*' },
    ...{ datasource: { type: 'prometheus', uid: '$source' }, refresh: 2, sort: 1 },
    ...{ query: { query: `label_values(${metric}, instance)`, refId: 'instances' }, current: {} },
  };
}

function timeSeries({ title, about, unit, queries, badFrom }: Panel, id: number, gridPos: object): object {
  const steps = [
    { color: 'green', value: null },
    ...(badFrom === undefined ? [] : [{ color: 'red', value: badFrom }]),
  ];
  return {
    ...{ id, type: 'timeseries', title, description: about, gridPos },
    datasource: { type: 'prometheus', uid: '$source' },
    fieldConfig: {
      defaults: {
        ...{ unit, min: 0, thresholds: { mode: 'absolute', steps } },
        custom: {
          ...{ fillOpacity: 10, lineWidth: 1, showPoints: 'never', spanNulls: false },
          thresholdsStyle: { mode: badFrom === undefined ? 'off' : 'line' },
        },
      },
      overrides: [],
    },
    options: {
      legend: { displayMode: 'list', placement: 'bottom', showLegend: true },
      tooltip: { mode: 'multi', sort: 'desc' },
    },
    targets: queries.map(({ expr, legend }, index) => ({
      ...{ refId: String.fromCharCode(65 + index), expr, legendFormat: legend, range: true },
      datasource: { type: 'prometheus', uid: '$source' },
    })),
  };
}
