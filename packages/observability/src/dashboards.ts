/** What the dashboards show: first what an operator feels, then where it comes from. */
import type { Dashboard, Panel, Query, Unit } from './dashboard.ts';

const OF = '{instance=~"$robot"}';
const RATE = '[$__rate_interval]';

/** One query. `{{instance}}` comes first in each legend, since several robots may be chosen. */
const one = (expr: string, legend = ''): Query => ({ expr, legend: `{{instance}} ${legend}`.trim() });
const gauge = (metric: string, legend?: string): Query => one(`${metric}${OF}`, legend);
/** @param by the label by which the counter is split */
const rate = (metric: string, by: string | null = null, legend?: string): Query =>
  by === null
    ? one(`rate(${metric}${OF}${RATE})`, legend)
    : one(`sum by (instance, ${by}) (rate(${metric}${OF}${RATE}))`, legend ?? `{{${by}}}`);

function panel(title: string, unit: Unit, about: string, queries: readonly Query[], badFrom?: number): Panel {
  return { title, unit, about, queries, ...(badFrom === undefined ? {} : { badFrom }) };
}

const robots: Dashboard = {
  uid: 'farpoint-robots',
  title: 'Farpoint robots',
  about: 'What operators get from their robots, how safe the robots are, and what the links give.',
  instancesOf: 'farpoint_robot_operators',
  rows: [
    {
      title: 'Operators',
      panels: [
        panel('Operators', 'short', 'Operators with a session.', [gauge('farpoint_robot_operators')]),
        panel(
          'Ends of sessions',
          'ops',
          'By reason. A “lost” operator had no path for longer than a session is kept.',
          [rate('farpoint_robot_sessions_ended_total', 'reason')],
        ),
        panel('Refused', 'ops', 'Sessions, grants, answers and messages that the robot refused.', [
          rate('farpoint_robot_sessions_refused_total', null, 'sessions'),
          rate('farpoint_robot_grants_refused_total', 'reason', 'grants: {{reason}}'),
          rate('farpoint_robot_answers_ignored_total', 'reason', 'answers: {{reason}}'),
          rate('farpoint_robot_datagrams_refused_total', 'reason', 'datagrams: {{reason}}'),
        ]),
      ],
    },
    {
      title: 'Safety',
      panels: [
        panel('Commands', 'cps', 'Drive commands that moved the robot, and those that it refused.', [
          rate('farpoint_robot_commands_accepted_total', null, 'accepted'),
          rate('farpoint_robot_commands_rejected_total', 'reason', 'refused: {{reason}}'),
        ]),
        panel(
          'Bounds on motion',
          'ops',
          'How often something began to bound the motion: a late picture, an obstacle, silence.',
          [rate('farpoint_robot_interventions_total', 'reason')],
        ),
        panel(
          'Stops at the robot',
          'ops',
          'Stops by a button, a byte in shared memory, a topic, or the console.',
          [rate('farpoint_robot_robot_stops_total', 'stop')],
        ),
        panel(
          'Age of what the obstacle guard has',
          's',
          'Beyond the limit it is blind, and the robot slow.',
          [
            gauge('farpoint_robot_guard_sensor_age_seconds', '{{sensor}}'),
            gauge('farpoint_robot_guard_odometry_age_seconds', 'odometry'),
          ],
          0.5,
        ),
        panel('Obstacle guard', 'short', '1 for its state.', [
          gauge('farpoint_robot_guard_state', '{{state}}'),
        ]),
        panel(
          'Wheels and stops',
          'bool_yes_no',
          'Whether something takes the velocities, and whether every stop can be read.',
          [
            gauge('farpoint_robot_wheels_present', 'wheels'),
            gauge('farpoint_robot_robot_stops_well', 'stops'),
          ],
        ),
      ],
    },
    {
      title: 'Clouds',
      panels: [
        panel('Clouds', 'ops', 'Captured, and those of which every point was coded.', [
          rate('farpoint_robot_frames_captured_total', null, 'captured'),
          rate('farpoint_robot_frames_whole_total', null, 'whole'),
          gauge('farpoint_robot_frames_per_second_planned', 'planned'),
        ]),
        panel('Points of a cloud', 'short', 'Valid ones, and those of them that were sent.', [
          gauge('farpoint_robot_valid_points', 'valid'),
          gauge('farpoint_robot_points_per_frame', 'sent'),
        ]),
        panel(
          'Clouds lost at the robot',
          'ops',
          'Too late, or without a buffer: the robot’s processor is too slow.',
          [
            rate('farpoint_robot_frames_stale_total', null, 'too late'),
            rate('farpoint_robot_frames_without_buffer_total', null, 'without a buffer'),
            rate('farpoint_robot_source_faults_total', null, 'faults of the source'),
          ],
        ),
        panel('Processor', 'percentunit', 'Of one core, by stage.', [
          rate('farpoint_robot_stage_seconds_total', 'stage'),
        ]),
      ],
    },
    {
      title: 'Links',
      panels: [
        panel('Rate', 'bps', 'Of the narrowest path: estimated, asked for, and arrived.', [
          gauge('farpoint_robot_rate_estimate_bits_per_second', 'estimate'),
          gauge('farpoint_robot_rate_target_bits_per_second', 'target'),
          gauge('farpoint_robot_rate_acknowledged_bits_per_second', 'arrived'),
        ]),
        panel(
          'Queue',
          's',
          'How long packets wait in the path’s queue.',
          [gauge('farpoint_robot_rate_queue_seconds')],
          0.06,
        ),
        panel(
          'Loss',
          'percentunit',
          'Of packets, recently.',
          [gauge('farpoint_robot_rate_loss_ratio')],
          0.05,
        ),
        panel(
          'ICE',
          'ops',
          'Restarts that were offered to operators without a path, and candidates that were refused.',
          [
            rate('farpoint_robot_ice_restarts_total', null, 'restarts'),
            rate('farpoint_robot_ice_candidates_refused_total', 'reason', 'refused: {{reason}}'),
          ],
        ),
        panel('Signaling', 'ops', 'Lost connections, errors, unreadable messages.', [
          rate('farpoint_robot_signaling_disconnects_total', null, 'lost'),
          rate('farpoint_robot_signaling_errors_total', 'code', 'errors: {{code}}'),
          rate('farpoint_robot_signaling_malformed_total', null, 'unreadable'),
        ]),
        panel('Registered', 'bool_yes_no', 'Whether operators can find the robot.', [
          gauge('farpoint_robot_signaling_registered'),
        ]),
      ],
    },
    {
      title: 'Program',
      panels: [
        panel('Memory', 'bytes', 'Resident.', [gauge('process_resident_memory_bytes')]),
        panel('Processor of the whole program', 'percentunit', 'Of one core.', [
          rate('process_cpu_seconds_total'),
        ]),
        panel('Lag of the event loop', 's', 'The longest since the last scrape. Commands wait as long.', [
          gauge('nodejs_eventloop_lag_max_seconds'),
        ]),
      ],
    },
  ],
};

const signaling: Dashboard = {
  uid: 'farpoint-signaling',
  title: 'Farpoint signaling',
  about: 'Who is connected, what is relayed, and what is refused.',
  instancesOf: 'farpoint_signaling_robots',
  rows: [
    {
      title: 'Who is there',
      panels: [
        panel('Robots', 'short', 'By protocol.', [gauge('farpoint_signaling_robots', '{{protocol}}')]),
        panel('WebSockets', 'short', 'By role.', [gauge('farpoint_signaling_connections', '{{role}}')]),
        panel('Sessions', 'short', 'Being set up, or running.', [gauge('farpoint_signaling_sessions')]),
      ],
    },
    {
      title: 'What happens',
      panels: [
        panel('Sessions', 'ops', 'Opened, and ended by reason.', [
          rate('farpoint_signaling_sessions_total', null, 'opened'),
          rate('farpoint_signaling_session_ends_total', 'reason'),
        ]),
        panel('Relayed', 'ops', 'Messages by type.', [rate('farpoint_signaling_relays_total', 'type')]),
        panel(
          'Time to relay',
          's',
          'From reading a message to handing it to the receiver’s socket: 99 of 100 are quicker.',
          [
            one(
              `histogram_quantile(0.99, sum by (instance, le) (rate(farpoint_signaling_relay_seconds_bucket${OF}${RATE})))`,
              'p99',
            ),
          ],
          0.01,
        ),
        panel('Refused', 'ops', 'Messages and connections, by role and reason.', [
          one(
            `sum by (instance, role, reason) (rate(farpoint_signaling_rejects_total${OF}${RATE}))`,
            '{{role}}: {{reason}}',
          ),
        ]),
      ],
    },
    {
      title: 'Program',
      panels: [
        panel('Memory', 'bytes', 'Resident.', [gauge('process_resident_memory_bytes')]),
        panel('Processor', 'percentunit', 'Of one core.', [rate('process_cpu_seconds_total')]),
        panel('Lag of the event loop', 's', 'The longest since the last scrape.', [
          gauge('nodejs_eventloop_lag_max_seconds'),
        ]),
      ],
    },
  ],
};

export const dashboards: readonly Dashboard[] = [robots, signaling];
