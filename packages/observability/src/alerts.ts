/** Alerts for Prometheus: what somebody must look at, and what to do first. */
import { stringify } from 'yaml';

export interface AlertRule {
  readonly name: string;
  /** PromQL that has a result while something is wrong. */
  readonly expr: string;
  /** How long that must last, a Prometheus duration. */
  readonly lasting: string;
  readonly severity: 'page' | 'ticket';
  readonly summary: string;
  /** What to do first. */
  readonly action: string;
}

export const alertRules: readonly AlertRule[] = [
  {
    name: 'FarpointProgramGone',
    expr: 'up{job=~"farpoint-.*"} == 0',
    ...{ lasting: '1m', severity: 'page' },
    summary: '{{ $labels.job }} at {{ $labels.instance }} does not answer.',
    action: 'Look at its log (journalctl -u {{ $labels.job }}) and at the machine.',
  },
  {
    name: 'FarpointRobotNotRegistered',
    expr: 'farpoint_robot_signaling_registered == 0',
    ...{ lasting: '2m', severity: 'page' },
    summary: 'No operator can find {{ $labels.instance }}: it is not registered with the signaling service.',
    action: 'On the robot, run farpoint-robot doctor.',
  },
  {
    name: 'FarpointStopUnreadable',
    expr: 'farpoint_robot_robot_stops_well == 0',
    ...{ lasting: '10s', severity: 'page' },
    summary: '{{ $labels.instance }} stands still, because a stop at the robot cannot be read.',
    action: 'Look at /healthz of the robot, which names the stop, and at its wires or its program.',
  },
  {
    name: 'FarpointGuardBlind',
    expr: 'farpoint_robot_guard_state{state="blind"} == 1 and on (instance) farpoint_robot_operators > 0',
    ...{ lasting: '30s', severity: 'page' },
    summary: '{{ $labels.instance }} is driven without its obstacle guard seeing anything.',
    action:
      'Look at the ages of its sensors (farpoint_robot_guard_sensor_age_seconds), and at the camera’s program.',
  },
  {
    name: 'FarpointWheelsGone',
    expr: 'farpoint_robot_wheels_present == 0 and on (instance) farpoint_robot_operators > 0',
    ...{ lasting: '30s', severity: 'ticket' },
    summary: 'Nothing takes the velocities of {{ $labels.instance }}, although somebody has a session.',
    action: 'Look at the program that drives the wheels.',
  },
  {
    name: 'FarpointLinkQueue',
    expr: 'farpoint_robot_rate_queue_seconds > 0.2',
    ...{ lasting: '1m', severity: 'ticket' },
    summary: 'Packets of {{ $labels.instance }} wait {{ $value | humanizeDuration }} in the path’s queue.',
    action: 'Something else fills the link, or it is too slow for the lowest rate: see --min-mbps.',
  },
  {
    name: 'FarpointCloudsLate',
    expr: 'rate(farpoint_robot_frames_stale_total[5m]) > 0.2 * rate(farpoint_robot_frames_captured_total[5m])',
    ...{ lasting: '5m', severity: 'ticket' },
    summary: 'A fifth of the clouds of {{ $labels.instance }} are too late when they are ready.',
    action: 'Its processor is too slow for what it is asked: lower the frame rate or the number of points.',
  },
  {
    name: 'FarpointRefusals',
    expr: 'sum by (instance, reason) (rate(farpoint_signaling_rejects_total[5m])) > 1',
    ...{ lasting: '5m', severity: 'ticket' },
    summary: '{{ $labels.instance }} refuses {{ $value | humanize }} a second: {{ $labels.reason }}.',
    action: 'Its log names the addresses. A wrong token in a fleet looks like this, and so does an attack.',
  },
  {
    name: 'FarpointRelaySlow',
    expr: 'histogram_quantile(0.99, sum by (instance, le) (rate(farpoint_signaling_relay_seconds_bucket[5m]))) > 0.05',
    ...{ lasting: '5m', severity: 'ticket' },
    summary: '{{ $labels.instance }} takes more than 50 ms to relay a message.',
    action: 'The machine is too busy for the service.',
  },
];

/** @returns a rules file of Prometheus */
export function alertsYaml(rules: readonly AlertRule[]): string {
  return stringify(
    {
      groups: [
        {
          name: 'farpoint',
          rules: rules.map(({ name, expr, lasting, severity, summary, action }) => ({
            ...{ alert: name, expr, for: lasting },
            ...{ labels: { severity }, annotations: { summary, action } },
          })),
        },
      ],
    },
    { lineWidth: 0 },
  );
}
