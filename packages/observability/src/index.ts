export { type AlertRule, alertRules, alertsYaml } from './alerts.ts';
export { type Dashboard, grafanaDashboard, type Panel, type Query, type Unit } from './dashboard.ts';
export { dashboards } from './dashboards.ts';
