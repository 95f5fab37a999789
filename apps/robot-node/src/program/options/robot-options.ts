/** Turns option values that are valid one by one into the parts of the robot. */
import { randomBytes } from 'node:crypto';
import { join } from 'node:path';
import { MOST_RESUME_MS } from '@farpoint/protocol';
import {
  modelReading,
  RosFault,
  readUrdf,
  type TopicEntry,
  type TopicReading,
  topicAs,
  UrdfFault,
} from '@farpoint/ros';
import { defaultDriveLimits } from '@farpoint/safety';
import { type OptionMistake, OptionsError, ownNames, publicValues, Secret } from '@farpoint/service';
import { simUrdf } from '@farpoint/sim';
import { BitRate } from '@farpoint/timing';
import type { RobotAuditOptions } from '../../admit/audit/open-robot-audit.ts';
import { describeTopics, readFrom, sourcedFolders } from '../../ground/ros/message-folders.ts';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import type { SinkOptions } from '../../motion/drive/open-sink.ts';
import type { RobotStopsOptions } from '../../motion/stops/open-stops.ts';
import { SIM_FIX, SIM_MOTORS } from '../../sense/base/sim-topics.ts';
import type { VideoCameraOptions } from '../../serve/cameras/open-video-cameras.ts';
import { describeQuantities } from '../../tell/sample-board.ts';
import type { RobotOptions } from '../robot-configuration.ts';
import { toAlarmRules } from './alarms.ts';
import { toBroadcast } from './broadcast.ts';
import { checkAccess } from './check-access.ts';
import { checkVideos } from './check-videos.ts';
import { toObstacleGuard } from './guard.ts';
import { toGuardTopics } from './guard-topics.ts';
import { toMotion } from './motion.ts';
import { readCertificates, readText } from './read-text.ts';
import { type RobotOptionKey, type RobotOptionValues, robotProgram } from './robot-program.ts';
import { rosKindOf } from './sink.ts';
import { tracesUrl } from './spans.ts';
import { toStateFolder } from './state.ts';
import { toCommands } from './to-commands.ts';
import { toFence } from './to-fence.ts';
import { toGraph } from './to-graph.ts';
import { toReturn } from './to-return.ts';
import { toSensors } from './to-sensors.ts';

/** Names the model in readings if it does not come from a topic. */
const MODEL_TOPIC = '/robot_description';
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
    return modelReading(MODEL_TOPIC, undefined, { kind: 'model', model: readUrdf(text, rosBaseFrame) });
  } catch (error) {
    if (!(error instanceof UrdfFault)) throw error;
    refuse('urdf', `${urdf}: ${error.message}`);
    return undefined;
  }
}

/**
 * Who has lost a connection while driving comes back within this time, or has gone, ms. Chosen: a tunnel or a
 * restart of the browser; a place that is kept longer keeps others out
 * (docs/decisions/2026-11-30-fewer-options.md).
 */
const KEEP_PLACE_MS = 30_000;
/**
 * JPEG's quality, and the pictures' most share of the link's rate: what the clouds can do without. `pnpm
 * bench pictures` measures both (docs/ros.md).
 */
const PICTURE_QUALITY = 70;
const PICTURE_SHARE = 0.15;
/** As a camera's own default, bit/s (docs/video.md). */
const PLAYED_VIDEO_BITS_PER_S = 1_500_000;

/** How messages say where an option's value comes from. */
export type Where = (key: RobotOptionKey) => string;

/** @throws {OptionsError} with all faults that only show when options are combined, or in files */
export function toRobotOptions(values: RobotOptionValues, where: Where): RobotOptions {
  const mistakes: OptionMistake[] = [];
  const refuse = (key: RobotOptionKey, detail: string) => mistakes.push({ where: where(key), detail });
  checkSource(values, refuse);
  const topics = describedTopics(values, (detail) => refuse('topics', detail));
  const ca = readCertificates(values.tlsCa, (detail) => refuse('tlsCa', detail));
  checkAccess(values, refuse);
  const ofSim = values.source !== 'sim' ? [] : [SIM_MOTORS, ...(values.simOrigin === null ? [] : [SIM_FIX])];
  const quantities = describeQuantities([...topics, ...ofSim]);
  const alarms = toAlarmRules(values.alarms, quantities, (detail) => refuse('alarms', detail));
  const obstacleGuard = toObstacleGuard(
    values,
    toGuardTopics(values, topics, (kind) => toGraph(values, kind), refuse),
    refuse,
  );
  const broadcast = toBroadcast(values, ca, refuse);
  const motion = toMotion(values, refuse);
  const fence = toFence(values, refuse);
  const model = toModel(values, refuse);
  const returns = toReturn(values, refuse, (kind) => toGraph(values, kind));
  const commands = toCommands(values, refuse, (kind) => toGraph(values, kind));
  const folder = toStateFolder(values, process.env, refuse);
  if (mistakes.length > 0) throw new OptionsError(mistakes);
  return {
    ...toIdentity(values, folder, ca),
    ...toLimits(values),
    ...toStreams(values),
    ...toConnections(values),
    ...toFiles(values),
    spans: toSpans(values, ca),
    sensors: toSensors(values, topics),
    base: toBase(values),
    sink: toSink(values),
    motion,
    obstacleGuard,
    quantities,
    alarms,
    fence,
    returns,
    commands,
    model,
    stops: toStops(values, (kind) => toGraph(values, kind)),
    broadcast,
  };
}

function toIdentity(values: RobotOptionValues, folder: string, ca: RobotOptions['signaling']['ca']) {
  return {
    id: values.id,
    name: values.name,
    signaling: {
      url: values.signaling,
      key: values.key ?? new Secret(randomBytes(16).toString('hex')),
      token: values.token,
      ca,
    },
    grantKeys: values.grantKeys ?? undefined,
    robotKey: values.robotKey ?? join(folder, `${values.id}.key.json`),
    revocations: values.revocations,
    watchersPoint: values.watchersPoint,
    listStatus: values.listStatus,
    version: robotProgram.version,
    audit: toAudit(values),
    stateFolder: folder,
  } satisfies Partial<RobotOptions>;
}

function toBase(values: RobotOptionValues): RobotOptions['base'] {
  if (values.source !== 'sim') return null;
  return {
    watchdogMs: values.watchdogMs,
    maxLateral: values.maxLateral,
    charge: values.simCharge / 100,
    origin: values.simOrigin,
    things: values.simThings ?? [],
    navigation: { map: values.simPlanTo !== null, planTo: values.simPlanTo },
  };
}

/** How fast the robot may be, and who may drive it for how long. */
function toLimits(values: RobotOptionValues) {
  return {
    limits: {
      maxLinear: values.maxLinear,
      // Operators from before it refuse limits that have it: it is left out where it says nothing.
      ...(values.maxLateral === 0 ? {} : { maxLateral: values.maxLateral }),
      maxAngular: values.maxAngular,
      watchdogMs: values.watchdogMs,
      maxCommandsPerSecond: defaultDriveLimits.maxCommandsPerSecond,
    },
    takePolicy: values.takePolicy,
    estopRelease: values.estopRelease,
    afterGap: values.afterGap,
    resumeWithinMs: values.afterGap === 'resume' ? MOST_RESUME_MS : values.resumeWithinMs,
    places: {
      most: values.maxOperators,
      perSubject: Math.ceil(values.maxOperators / 2),
      keepMs: KEEP_PLACE_MS,
    },
    silenceMs: values.silenceS * 1000,
    leaseSilenceMs: values.leaseSilenceS * 1000,
  } satisfies Partial<RobotOptions>;
}

/** What goes over the link. */
function toStreams(values: RobotOptionValues) {
  return {
    bitsPerSecond: BitRate.fromMbps(values.bitrateMbps),
    mode: values.mode,
    rateControl: values.rateControl,
    startBitsPerSecond: BitRate.fromMbps(values.startMbps),
    pictures: {
      perSecond: values.picturesPerSecond,
      longestSide: values.picturesLongestSide,
      quality: PICTURE_QUALITY,
      share: PICTURE_SHARE,
    },
    videos: toVideos(values),
    playedVideosBitsPerSecond: PLAYED_VIDEO_BITS_PER_S,
    sound: values.sound,
  } satisfies Partial<RobotOptions>;
}

function toConnections(values: RobotOptionValues) {
  return {
    referenceSignaling: values.referenceSignaling ?? undefined,
    connectTimeoutMs: 20_000,
    iceServers: values.iceServers,
    icePolicy: values.icePolicy,
    portRange: values.udpPorts ?? undefined,
    foxglove: toFoxglove(values),
  } satisfies Partial<RobotOptions>;
}

/** What is written while the robot runs. */
function toFiles(values: RobotOptionValues) {
  return {
    measurementFolder: values.measure ?? undefined,
    record: toRecording(values),
  } satisfies Partial<RobotOptions>;
}

function toSpans(values: RobotOptionValues, ca: string | null): RobotOptions['spans'] {
  if (values.otlpEndpoint === null) return undefined;
  const url = tracesUrl(values.otlpEndpoint);
  return { url, ca: ca ?? undefined, robotId: values.id, version: robotProgram.version };
}

function toFoxglove(values: RobotOptionValues): RobotOptions['foxglove'] {
  if (values.foxglovePort === null) return undefined;
  return {
    port: values.foxglovePort,
    reach: values.foxgloveReach,
    allowedOrigins: values.foxgloveOrigins,
    ownNames: [...ownNames(values.adminNames)],
    cloudsPerSecond: values.foxgloveFps,
  };
}

function toRecording(values: RobotOptionValues): RobotOptions['record'] {
  const { record, recordFolder } = values;
  if (record === null && recordFolder === null) return undefined;
  const recorded = (kind: 'captured' | 'sent') => [kind, 'both'].includes(values.recordClouds);
  return {
    path: record,
    folder: recordFolder === null ? null : { path: recordFolder, mostBytes: values.recordFolderMax },
    compression: values.recordCompression,
    clouds: {
      captured: recorded('captured') ? values.recordFps : 0,
      sent: recorded('sent') ? values.recordFps : 0,
    },
    videos: values.recordVideos,
    mostBytes: values.recordMax,
  };
}

function checkSource(values: RobotOptionValues, refuse: (key: RobotOptionKey, detail: string) => void): void {
  const { source, path } = values;
  const played = source === 'recording' || source === 'pcd' || source === 'rgbd';
  if (played && path === null) refuse('path', `is needed for the source ${source}`);
  const { topics, sink } = values;
  const ros = source === 'ros1' || source === 'ros2';
  if (ros && topicAs(topics, 'cloud') === undefined && topicAs(topics, 'depth') === undefined) {
    refuse('topics', `needs an entry with \`as: cloud\` or \`as: depth\` for the source ${source}`);
  }
  if (!ros && source !== 'recording' && topicAs(topics, 'picture') !== undefined) {
    refuse('topics', 'can have `as: picture` only with the source ros1, ros2 or recording');
  }
  if ((sink === 'ros1' || sink === 'ros2') && topicAs(topics, 'velocity') === undefined) {
    refuse('topics', `needs an entry with \`as: velocity\` for the sink ${sink}`);
  }
  checkVideos(values, refuse);
  if (values.stopTopic !== null && rosKindOf(values) === null)
    refuse('stopTopic', 'needs a ROS graph: neither source nor sink is ROS');
  if (source === 'sim' && values.simSize % 4 !== 0) refuse('simSize', 'must be a multiple of 4');
}

function toVideos(values: RobotOptionValues): VideoCameraOptions[] {
  return values.videos.map((camera, index) => {
    const { source, ...rest } = camera;
    if (source.kind === 'sim') {
      const { kind, framesPerS, ...placed } = source;
      // A seed of its own, so that no two cameras have the same noise.
      const seed = (values.simSeed + 1000 + index) % 2 ** 32;
      return { ...rest, source: { kind, framesPerS, seed, camera: placed } };
    }
    if (source.kind !== 'ros') return { ...rest, source };
    const { kind, version, entry } = source;
    const graph = toGraph(values, version === undefined ? (rosKindOf(values) ?? 'ros2') : `ros${version}`);
    return { ...rest, source: { kind, graph, entry } };
  });
}

/** ROS 1's publishers describe their messages; ROS 2's do not. */
function describedTopics(
  { source, topics, rosMessages }: RobotOptionValues,
  refuse: (detail: string) => void,
): TopicEntry[] {
  if (source !== 'ros2') return topics;
  try {
    return describeTopics(topics, readFrom([...rosMessages, ...sourcedFolders(process.env)]));
  } catch (error) {
    if (!(error instanceof RosFault)) throw error;
    refuse(`${error.message} (searched: the folders of ros.messages, and ROS where it is sourced)`);
    return topics;
  }
}

function toSink(values: RobotOptionValues): SinkOptions {
  if (values.sink === 'source') return { kind: 'base' };
  if (values.sink === 'ros1' || values.sink === 'ros2') {
    const entry = topicAs(values.topics, 'velocity');
    if (entry === undefined) throw new Error('checked before: there is a topic for velocities');
    return { kind: 'ros', graph: toGraph(values, values.sink), entry, silenceMs: values.watchdogMs };
  }
  return {
    kind: 'shm',
    folder: values.shmFolder,
    owner: values.shmOwner ?? undefined,
    mode: values.shmAccess === 'group' ? 0o660 : 0o600,
    silenceMs: values.watchdogMs,
    readerRequired: values.shmReader === 'required',
  };
}

/** @returns undefined if nothing is recorded */
function toAudit(values: RobotOptionValues): RobotAuditOptions | undefined {
  if (values.auditLog === null) return undefined;
  const { options, version } = robotProgram;
  const configuration = publicValues(options, values);
  return { path: values.auditLog, maxBytes: values.auditMax, version, configuration };
}

/** @param graph the robot's graph of this kind */
function toStops(
  values: RobotOptionValues,
  graph: (kind: GraphOptions['kind']) => GraphOptions,
): RobotStopsOptions {
  const { stopTopic: topic, stopShm, stopGpio, stopKey: key, stopSilenceMs: silentMs } = values;
  const kind = rosKindOf(values);
  const { shmFolder, shmOwner } = values;
  return {
    ...(topic === null || kind === null ? {} : { topic: { graph: graph(kind), topic, silentMs } }),
    ...(stopShm === null
      ? {}
      : { shm: { path: join(shmFolder, stopShm), owner: shmOwner ?? undefined, silentMs } }),
    ...(stopGpio === null ? {} : { gpio: stopGpio }),
    key,
  };
}
