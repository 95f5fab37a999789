/** All options of the robot program. Each group has its own file. */
import {
  adminOptions,
  defineProgram,
  mergeGroups,
  type OptionTable,
  type OptionValues,
} from '@farpoint/service';
import manifest from '../../../package.json' with { type: 'json' };
import { accessOptions } from './access.ts';
import { alarmsOptions } from './alarms.ts';
import { broadcastOptions } from './broadcast.ts';
import { commandsOptions } from './commands.ts';
import { fenceOptions } from './fence.ts';
import { guardOptions } from './guard.ts';
import { guardTopicsOptions } from './guard-topics.ts';
import { limitsOptions, motionOptions } from './motion.ts';
import { networkOptions } from './network.ts';
import { playbackOptions } from './playback.ts';
import { foxgloveOptions, measurementOptions, recordingOptions } from './recording.ts';
import { returnOptions } from './return.ts';
import { rosOptions, topicsOptions } from './ros.ts';
import { identityOptions, modelOptions, signalingOptions } from './signaling.ts';
import { simOptions } from './sim.ts';
import { sinkOptions } from './sink.ts';
import { shmOptions, sourceOptions } from './source.ts';
import { spanOptions } from './spans.ts';
import { auditOptions, stateOptions } from './state.ts';
import { stopsOptions } from './stops.ts';
import { picturesOptions, streamOptions } from './stream.ts';
import { soundOptions, videosOptions } from './videos.ts';

/** By what they are for: the headings of `--help all`. */
const groups = {
  'Name and signaling service': { ...identityOptions, ...signalingOptions },
  'Who may operate the robot, and what is recorded of it': { ...accessOptions, ...auditOptions },
  'Where clouds come from': { ...sourceOptions, ...shmOptions, ...playbackOptions, ...simOptions },
  'Wheels, topics and readings': {
    ...sinkOptions,
    ...topicsOptions,
    ...modelOptions,
    ...alarmsOptions,
    ...rosOptions,
  },
  'Limits of motion': { ...limitsOptions, ...motionOptions },
  'Emergency stops and the fence': { ...stopsOptions, ...fenceOptions },
  'Obstacle guard': { ...guardOptions, ...guardTopicsOptions },
  'Driving back by itself': returnOptions,
  'Robot commands': commandsOptions,
  State: stateOptions,
  'Clouds and pictures on the link': { ...streamOptions, ...picturesOptions },
  'Videos and sound': { ...videosOptions, ...soundOptions },
  'Broadcast through Janus': broadcastOptions,
  'Network paths': networkOptions,
  'Recordings and Foxglove': { ...recordingOptions, ...foxgloveOptions },
  'Health, metrics and measurement': { ...adminOptions(9400), ...spanOptions, ...measurementOptions },
} satisfies Record<string, OptionTable>;

const options = mergeGroups(groups);

export const robotProgram = defineProgram({
  name: 'farpoint-robot',
  summary:
    'The robot peer: captures point clouds, fits them to the link, streams them, and executes safe commands.',
  version: manifest.version,
  section: 'robot',
  commands: {
    init: 'writes a commented configuration file',
    doctor: 'checks everything and says what to fix',
    release: 'releases the emergency stop, at the robot',
    audit: 'verifies an audit log',
  },
  options,
  groups,
  basics: [
    'config',
    'id',
    'name',
    'signaling',
    'token',
    'grantKeys',
    'source',
    'path',
    'fps',
    'sink',
    'urdf',
    'maxLinear',
    'maxAngular',
    'obstacleGuard',
    'footprint',
    'fence',
    'return',
    'bitrateMbps',
    'maxOperators',
    'iceServers',
    'udpPorts',
    'record',
    'foxglovePort',
    'stateDir',
    'logLevel',
  ],
});

export type RobotOptionValues = OptionValues<typeof options>;
export type RobotOptionKey = keyof typeof options & string;
