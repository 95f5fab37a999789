import { type DriveLimits, PROTOCOL_VERSION } from '@farpoint/protocol';
import type { CloudSensors } from '../sensors/cloud-sensors.ts';
import type { OperatorSession } from './operator-session.ts';

export interface WelcomeFacts {
  id: string;
  name: string;
  limits: DriveLimits;
  /** The first sensor's highest frame rate. */
  framesPerSecond: number;
}

/** Sends a session's first messages: what the robot is, who drives, and which cameras and sensors there are. */
export function welcome(
  { messages, resumeKey }: OperatorSession,
  { id, name, limits, framesPerSecond }: WelcomeFacts,
  sensors: CloudSensors,
): void {
  const { description, cameras } = sensors.first.capture;
  const { width, height } = description;
  messages.send({
    type: 'welcome',
    protocol: PROTOCOL_VERSION,
    robotId: id,
    name,
    limits,
    stream: { format: 'points64', width, height, framesPerSecond },
    resumeKey: resumeKey.text,
  });
  messages.sendLease();
  messages.sendEstop();
  if (cameras.length > 0) messages.send({ type: 'cameras', cameras: cameras.map(({ name }) => ({ name })) });
  if (sensors.all.length > 1) {
    messages.send({ type: 'sensors', sensors: sensors.all.map(({ name }) => ({ name })) });
  }
}
