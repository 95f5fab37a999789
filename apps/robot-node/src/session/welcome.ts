import { type DriveLimits, PROTOCOL_VERSION } from '@farpoint/protocol';
import type { CloudSensors } from '../sensors/cloud-sensors.ts';
import type { ConnectedOperator } from './connected-operator.ts';

export interface WelcomeFacts {
  id: string;
  name: string;
  limits: DriveLimits;
  /** Of the first sensor, at most. */
  framesPerSecond: number;
}

/** The first messages of a session: what the robot is, who drives, and what there is to see. */
export function welcome(
  { session, resumeKey }: ConnectedOperator,
  { id, name, limits, framesPerSecond }: WelcomeFacts,
  sensors: CloudSensors,
): void {
  const { description, cameras } = sensors.first.capture;
  const { width, height } = description;
  session.send({
    type: 'welcome',
    protocol: PROTOCOL_VERSION,
    robotId: id,
    name,
    limits,
    stream: { format: 'points64', width, height, framesPerSecond },
    resumeKey: resumeKey.text,
  });
  session.sendLease();
  session.sendEstop();
  if (cameras.length > 0) session.send({ type: 'cameras', cameras: cameras.map(({ name }) => ({ name })) });
  if (sensors.all.length > 1) {
    session.send({ type: 'sensors', sensors: sensors.all.map(({ name }) => ({ name })) });
  }
}
