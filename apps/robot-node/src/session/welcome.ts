import { type Alarm, PROTOCOL_VERSION, type Quantity, type VideoCodec } from '@farpoint/protocol';
import type { RobotOptions } from '../robot-configuration.ts';
import type { CloudSensors } from '../sensors/cloud-sensors.ts';
import type { VideoHub } from '../video/video-hub.ts';
import type { OperatorSession } from './operator-session.ts';

export interface WelcomeFacts extends Pick<RobotOptions, 'id' | 'name' | 'limits' | 'sensors'> {
  quantities: readonly Quantity[];
  /** Those that are raised. */
  alarms: readonly Alarm[];
  /** Seconds since 1970. */
  nowS: number;
}

/** Sends a session's first messages: what the robot is, who drives, and which cameras and sensors there are. */
export function welcome(
  operator: OperatorSession,
  { id, name, limits, sensors: configured, quantities, alarms, nowS }: WelcomeFacts,
  sensors: CloudSensors,
  videos: VideoHub,
): void {
  const { messages, resumeKey } = operator;
  const { description, cameras } = sensors.first.capture;
  const { width, height } = description;
  const { role, name: operatorName, expiresAtS } = messages.access;
  const expiresInS = Math.max(0, Math.floor(expiresAtS - nowS));
  const framesPerSecond = configured[0]?.capture.framesPerSecond ?? 0;
  messages.send({
    type: 'welcome',
    protocol: PROTOCOL_VERSION,
    robotId: id,
    name,
    limits,
    stream: { format: 'points64', width, height, framesPerSecond },
    resumeKey: resumeKey.text,
    ...(role === null ? {} : { access: { role, name: operatorName, expiresInS } }),
  });
  messages.sendLease();
  messages.sendEstop();
  for (const message of [...quantities, ...alarms]) messages.send(message);
  if (cameras.length > 0) messages.send({ type: 'cameras', cameras: cameras.map(({ name }) => ({ name })) });
  if (sensors.all.length > 1) {
    messages.send({ type: 'sensors', sensors: sensors.all.map(({ name }) => ({ name })) });
  }
  tellVideos(operator, videos);
}

/** Tells an operator which videos there are, and which of them have no pictures. */
export function tellVideos({ messages, videos }: OperatorSession, { descriptions }: VideoHub): void {
  const { lines } = videos;
  if (lines.length === 0) return;
  messages.send({
    type: 'videos',
    videos: descriptions.map((description, video) => {
      const line = lines[video];
      const refused = line?.transport === null ? { fault: refusal(description.codec) } : {};
      return { ...description, ...refused, mid: line?.mid ?? '' };
    }),
  });
}

function refusal(codec: VideoCodec): string {
  return `this client does not decode ${codec}: give the camera another encoder (vp8enc works everywhere)`;
}
