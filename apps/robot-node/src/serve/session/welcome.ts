import {
  type AfterGap,
  type Alarm,
  type DriveLimits,
  PROTOCOL_VERSION,
  type Quantity,
  type RobotAbout,
  type RobotBody,
} from '@farpoint/protocol';
import { FLOOR_SLOPE } from '@farpoint/safety';
import type { ObstacleGuardConfiguration } from '../../motion/obstacles/guarded-sensors.ts';
import type { MotionLimits } from '../../motion/open-drive.ts';
import type { CloudSensor, CloudSensorOptions } from '../../send/clouds/cloud-sensor.ts';
import type { CloudSensors } from '../../send/clouds/cloud-sensors.ts';
import { codecFault } from '../../send/video/codec-fault.ts';
import type { VideoHub } from '../../sense/video/video-hub.ts';
import type { OperatorSession } from './operator-session.ts';

/** Of an elevation in radians: far finer than the angle between two rings of any LiDAR. */
const ELEVATION_DIGITS = 5;

export interface WelcomeFacts {
  /** Of the robot. */
  id: string;
  name: string;
  limits: DriveLimits;
  afterGap: AfterGap;
  resumeWithinMs: number;
  sensors: readonly CloudSensorOptions[];
  motion: MotionLimits;
  about: RobotAbout;
  obstacleGuard: ObstacleGuardConfiguration;
  quantities: readonly Quantity[];
  /** Those that are raised. */
  alarms: readonly Alarm[];
  /** Seconds since 1970. */
  nowS: number;
}

/** Sends a session's first messages: what the robot is, who drives, and which cameras and sensors there are. */
export function welcome(
  operator: OperatorSession,
  facts: WelcomeFacts,
  sensors: CloudSensors,
  videos: VideoHub,
): void {
  const { id, name, limits, afterGap, resumeWithinMs, sensors: configured, quantities, alarms, nowS } = facts;
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
    limits: { ...limits, afterGap, resumeWithinMs },
    body: bodyOf(facts),
    stream: { format: 'points64', width, height, framesPerSecond },
    resumeKey: resumeKey.text,
    ...(role === null ? {} : { access: { role, name: operatorName, expiresInS } }),
  });
  messages.sendLease();
  messages.sendEstop();
  for (const message of [facts.about, ...quantities, ...alarms]) messages.send(message);
  if (cameras.length > 0) messages.send({ type: 'cameras', cameras: cameras.map(({ name }) => ({ name })) });
  if (sensors.all.length > 1) {
    messages.send({ type: 'sensors', sensors: sensors.all.map(({ name }) => ({ name })) });
  }
  for (const sensor of sensors.all) tellRings(operator, sensor);
  tellVideos(operator, videos);
}

function bodyOf({ motion, obstacleGuard }: WelcomeFacts): RobotBody {
  const round = (metres: number) => Number(metres.toFixed(3));
  const { clearanceM, heightM, dropM } = obstacleGuard;
  return {
    footprint: obstacleGuard.footprint.map(({ x, y }) => ({ x: round(x), y: round(y) })),
    decelerationMps2: motion.ramps.decelerationMps2,
    accelerationMps2: motion.ramps.accelerationMps2,
    turnRadps2: motion.ramps.turnRadps2,
    heights: { clearanceM, heightM, dropM, slope: FLOOR_SLOPE },
  };
}

/** Tells an operator the rings of a sensor, if they are known. */
export function tellRings(
  { messages }: Pick<OperatorSession, 'messages'>,
  { number, capture: { rings } }: CloudSensor,
): void {
  if (rings === null) return;
  const elevations = rings.map((elevation) => Number(elevation.toFixed(ELEVATION_DIGITS)));
  messages.send({ type: 'rings', sensor: number, elevations });
}

/** Tells an operator which videos there are, and which of them have no pictures. */
export function tellVideos(
  { messages, videos }: Pick<OperatorSession, 'messages' | 'videos'>,
  { descriptions }: Pick<VideoHub, 'descriptions'>,
): void {
  const { lines } = videos;
  if (lines.length === 0) return;
  messages.send({
    type: 'videos',
    videos: descriptions.map((description, video) => {
      const line = lines[video];
      const fault = line === undefined ? null : codecFault(line, description.codec);
      return { ...description, ...(fault === null ? {} : { fault }), mid: line?.mid ?? '' };
    }),
  });
}
