/** All options of the robot program. Each group has its own file. */
import { adminOptions, defineProgram, type OptionTable, type OptionValues } from '@farpoint/service';
import manifest from '../../../package.json' with { type: 'json' };
import { accessOptions } from './access.ts';
import { alarmsOptions } from './alarms.ts';
import { broadcastOptions } from './broadcast.ts';
import { fenceOptions } from './fence.ts';
import { foxgloveOptions } from './foxglove.ts';
import { guardOptions } from './guard.ts';
import { guardTopicsOptions } from './guard-topics.ts';
import { identityOptions, modelOptions } from './identity.ts';
import { limitsOptions } from './limits.ts';
import { motionOptions } from './motion.ts';
import { networkOptions } from './network.ts';
import { picturesOptions } from './pictures.ts';
import { playbackOptions } from './playback.ts';
import { measurementOptions, recordingOptions } from './recording.ts';
import { returnOptions } from './return.ts';
import { rosOptions, topicsOptions } from './ros.ts';
import { shmOptions } from './shm.ts';
import { signalingOptions } from './signaling.ts';
import { simOptions } from './sim.ts';
import { sinkOptions } from './sink.ts';
import { soundOptions } from './sound.ts';
import { sourceOptions } from './source.ts';
import { auditOptions, stateOptions } from './state.ts';
import { stopsOptions } from './stops.ts';
import { streamOptions } from './stream.ts';
import { videosOptions } from './videos.ts';

const options = {
  ...identityOptions,
  ...signalingOptions,
  ...accessOptions,
  ...auditOptions,
  ...sourceOptions,
  ...shmOptions,
  ...playbackOptions,
  ...simOptions,
  ...sinkOptions,
  ...topicsOptions,
  ...modelOptions,
  ...alarmsOptions,
  ...rosOptions,
  ...limitsOptions,
  ...motionOptions,
  ...stopsOptions,
  ...fenceOptions,
  ...guardOptions,
  ...guardTopicsOptions,
  ...returnOptions,
  ...stateOptions,
  ...streamOptions,
  ...picturesOptions,
  ...videosOptions,
  ...soundOptions,
  ...broadcastOptions,
  ...networkOptions,
  ...recordingOptions,
  ...foxgloveOptions,
  ...adminOptions(9400),
  ...measurementOptions,
} satisfies OptionTable;

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
});

export type RobotOptionValues = OptionValues<typeof options>;
export type RobotOptionKey = keyof typeof options & string;
