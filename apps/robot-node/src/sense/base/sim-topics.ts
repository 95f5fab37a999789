/** What the simulated robot tells about itself, as the topics of a real robot would. */
import { topicTableSchema } from '@farpoint/ros';

export const MOTORS_TOPIC = '/motors';
const DIAGNOSTICS_TOPIC = '/diagnostics';
const FIX_TOPIC = '/fix';

const entries = topicTableSchema.parse([
  { topic: DIAGNOSTICS_TOPIC, as: 'diagnostics' },
  {
    topic: MOTORS_TOPIC,
    type: 'farpoint_msgs/msg/Motors',
    as: 'text',
    label: 'Motors',
    quantities: [
      { field: 'left', label: 'Left motor', unit: '°C' },
      { field: 'right', label: 'Right motor', unit: '°C' },
    ],
  },
  { topic: FIX_TOPIC, as: 'fix' },
  { topic: '/map', as: 'map' },
  { topic: '/plan', as: 'path' },
  { topic: '/joint_states', as: 'joints' },
]);
type Entry = (typeof entries)[number];
/** The fix only where the world has a place on the earth; map and plan only where they are asked for. */
export const [SIM_DIAGNOSTICS, SIM_MOTORS, SIM_FIX, SIM_MAP, SIM_PLAN, SIM_JOINTS] = entries as [
  Entry,
  Entry,
  Entry,
  Entry,
  Entry,
  Entry,
];
