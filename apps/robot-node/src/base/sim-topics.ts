/** What the simulated robot tells about itself, as the topics of a real robot would. */
import { topicTableSchema } from '@farpoint/ros';

export const MOTORS_TOPIC = '/motors';
export const DIAGNOSTICS_TOPIC = '/diagnostics';
const FIX_TOPIC = '/fix';

const entries = topicTableSchema.parse([
  { topic: DIAGNOSTICS_TOPIC, as: 'diagnostics' },
  {
    ...{ topic: MOTORS_TOPIC, type: 'farpoint_msgs/msg/Motors', as: 'text', label: 'Motors' },
    quantities: [
      { field: 'left', label: 'Left motor', unit: '°C' },
      { field: 'right', label: 'Right motor', unit: '°C' },
    ],
  },
  { topic: FIX_TOPIC, as: 'fix' },
]);
type Entry = (typeof entries)[number];
/** The last only where the world has a place on the earth. */
export const [SIM_DIAGNOSTICS, SIM_MOTORS, SIM_FIX] = entries as [Entry, Entry, Entry];
