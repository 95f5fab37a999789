/** `farpoint-robot init`: writes a configuration file with every option, explained. It asks no questions. */
import { writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { configSchema, configTemplate, DEFAULT_CONFIG_PATH } from '@farpoint/service';
import { playbackOptions } from '../options/playback.ts';
import { measurementOptions } from '../options/recording.ts';
import { robotProgram } from '../options/robot-program.ts';
import { rosOptions } from '../options/ros.ts';
import { simOptions } from '../options/sim.ts';
import { SOURCE_KINDS, shmOptions } from '../options/source.ts';

export type SourceKind = (typeof SOURCE_KINDS)[number];

const HEAD = [
  'Configuration of a Farpoint robot.',
  '',
  'Each option is taken from the first that gives it: command line, environment, this file, default.',
  'Lines that begin with "#" and a key show options at their defaults. To change one, remove the "#".',
  'An unknown key or a value that is not allowed is an error. `farpoint-robot doctor` checks the whole robot.',
  'Give secrets (signaling.token, signaling.key) in the environment: FARPOINT_ROBOT_TOKEN, FARPOINT_ROBOT_KEY.',
];

/** Options that every robot decides, at their defaults. */
const ALWAYS = [
  'id',
  'name',
  'signaling',
  'source',
  'sink',
  'maxLinear',
  'maxAngular',
  'watchdogMs',
  'bitrateMbps',
] as const;

/** The names that drivers of cameras and bases commonly use. */
const ROS_TOPICS = [
  { topic: '/camera/depth_registered/points', as: 'cloud' },
  { topic: '/camera/depth_registered/camera_info', as: 'cameraInfo' },
  { topic: '/tf', as: 'tf' },
  { topic: '/tf_static', as: 'tf' },
  { topic: '/odom', as: 'pose' },
  { topic: '/cmd_vel', as: 'velocity' },
];

/** Values of a template that differ from the defaults. */
const SET: Record<SourceKind, Readonly<Record<string, unknown>>> = {
  sim: {},
  pcd: {},
  rgbd: {},
  recording: {},
  shm: { shmLayout: 'farpoint', sink: 'shm' },
  ros1: { sink: 'ros1', topics: ROS_TOPICS },
  ros2: { sink: 'ros2', topics: ROS_TOPICS },
};

/** Options that only some kinds of sources have. */
const ONLY: readonly { kinds: readonly SourceKind[]; options: object }[] = [
  { kinds: ['sim'], options: simOptions },
  { kinds: ['shm'], options: shmOptions },
  { kinds: ['pcd', 'rgbd', 'recording'], options: playbackOptions },
  { kinds: ['ros1', 'ros2'], options: rosOptions },
  { kinds: [], options: measurementOptions },
];

/** @param audit file of the audit log */
export function robotTemplate(source: SourceKind, audit?: string): string {
  const { options } = robotProgram;
  return configTemplate(robotProgram, {
    head: HEAD,
    values: {
      ...Object.fromEntries(ALWAYS.map((key) => [key, options[key].default])),
      source,
      ...SET[source],
      ...(audit === undefined ? {} : { auditLog: audit }),
    },
    leftOut: ONLY.filter(({ kinds }) => !kinds.includes(source)).flatMap(({ options: table }) =>
      Object.keys(table),
    ),
  });
}

/** The parts of the process that a command may use. */
export interface CommandRim {
  stdout: { write(text: string): unknown };
  stderr: { write(text: string): unknown };
}

const DEFAULT_SCHEMA_PATH = 'farpoint.schema.json';

const HELP = `farpoint-robot init [--source KIND] [--output FILE] [--audit FILE] [--force]
farpoint-robot init --schema [--output FILE] [--force]

Writes a configuration file for a robot, with a comment for each option; or a JSON Schema of such files, by which an editor
completes and checks them. In the configuration file, the first line names it:
# yaml-language-server: $schema=${DEFAULT_SCHEMA_PATH}

  --source KIND  source of the clouds: ${SOURCE_KINDS.join(', ')} (default: sim)
  --output FILE  file to write (default: ${DEFAULT_CONFIG_PATH}, or ${DEFAULT_SCHEMA_PATH}); - for standard output
  --audit FILE   record who did what in this file (audit.log)
  --schema       write the JSON Schema
  --force        replace an existing file
`;

/** @returns the exit code: 0, 1 if the file could not be written, 2 for a mistake in the arguments */
export function init(argv: readonly string[], { stdout, stderr }: CommandRim): number {
  const refuse = (message: string, code: number): number => {
    stderr.write(`farpoint-robot init: ${message}\n`);
    return code;
  };
  let values: ReturnType<typeof parse>;
  try {
    values = parse(argv);
  } catch (error) {
    return refuse((error as Error).message, 2);
  }
  if (values.help) {
    stdout.write(HELP);
    return 0;
  }
  const source = SOURCE_KINDS.find((kind) => kind === values.source);
  if (source === undefined)
    return refuse(
      `--source must be one of ${SOURCE_KINDS.join(', ')}, not ${JSON.stringify(values.source)}`,
      2,
    );
  const text = values.schema
    ? `${JSON.stringify(configSchema(robotProgram), null, 2)}\n`
    : robotTemplate(source, values.audit);
  const output = values.output ?? (values.schema ? DEFAULT_SCHEMA_PATH : DEFAULT_CONFIG_PATH);
  if (output === '-') {
    stdout.write(text);
    return 0;
  }
  try {
    // The file may hold a token: limit who can read it.
    writeFileSync(output, text, { flag: values.force ? 'w' : 'wx', mode: 0o640 });
  } catch (error) {
    const { code, message } = error as NodeJS.ErrnoException;
    if (code === 'EEXIST') return refuse(`${output} already exists; --force replaces it`, 1);
    return refuse(`${output} cannot be written: ${message}`, 1);
  }
  stdout.write(values.schema ? `Wrote ${output}.\n` : `Wrote ${output}. Next: ${next(source, output)}\n`);
  return 0;
}

function next(source: SourceKind, output: string): string {
  const config = output === DEFAULT_CONFIG_PATH ? '' : ` --config ${output}`;
  const needs: Partial<Record<SourceKind, string>> = {
    recording: 'set source.path, ',
    pcd: 'set source.path, ',
    rgbd: 'set source.path, ',
  };
  return `${needs[source] ?? ''}set signaling.url, then \`farpoint-robot doctor${config}\`.`;
}

function parse(argv: readonly string[]) {
  const { values } = parseArgs({
    args: [...argv],
    options: {
      source: { type: 'string', default: 'sim' },
      output: { type: 'string' },
      schema: { type: 'boolean', default: false },
      audit: { type: 'string' },
      force: { type: 'boolean', default: false },
      help: { type: 'boolean', short: 'h', default: false },
    },
  });
  return values;
}
