import { modelReading, readUrdf, type TopicReading, topicAs, UrdfFault } from '@farpoint/ros';
import { simUrdf } from '@farpoint/sim';
import { readText } from './read-text.ts';
import type { RobotOptionKey, RobotOptionValues } from './robot-program.ts';

/** Names the model in readings if it does not come from a topic. */
const TOPIC = '/robot_description';
const NO_MODEL = 'none';

/** The model that is known from the start; undefined if there is none. @param refuse takes what is wrong */
export function toModel(
  { urdf, source, simLidars, topics, rosBaseFrame }: RobotOptionValues,
  refuse: (key: RobotOptionKey, detail: string) => void,
): TopicReading | undefined {
  if (urdf === NO_MODEL) return undefined;
  if (urdf !== null && topicAs(topics, 'model') !== undefined)
    refuse('urdf', 'is given, and a topic with `as: model`, too');
  if (urdf === null && source !== 'sim') return undefined;
  const text = urdf === null ? simUrdf(simLidars > 0) : readText(urdf, (detail) => refuse('urdf', detail));
  if (text === null) return undefined;
  try {
    return modelReading(TOPIC, undefined, { kind: 'model', model: readUrdf(text, rosBaseFrame) });
  } catch (error) {
    if (!(error instanceof UrdfFault)) throw error;
    refuse('urdf', `${urdf}: ${error.message}`);
    return undefined;
  }
}
