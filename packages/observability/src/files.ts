import { alertRules, alertsYaml } from './alerts.ts';
import { grafanaDashboard } from './dashboard.ts';
import { dashboards } from './dashboards.ts';

/** The committed files, by their paths in this package. */
export function files(): Map<string, string> {
  return new Map([
    ...dashboards.map(
      (each) => [`grafana/${each.uid}.json`, `${JSON.stringify(grafanaDashboard(each), null, 2)}\n`] as const,
    ),
    ['prometheus/alerts.yaml', alertsYaml(alertRules)],
  ]);
}
