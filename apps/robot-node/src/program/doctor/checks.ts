/** All checks of the doctor, ordered so that the fault that is easiest to understand is reported first. */

import { cpus, loadavg, networkInterfaces } from 'node:os';
import type { IceServer } from '@farpoint/protocol';
import type { CaptureOptions } from '../../sense/capture/capture-messages.ts';
import { ANTEROOM } from '../../serve/session/operator-places.ts';
import type { RobotOptionValues } from '../options/robot-program.ts';
import type { RobotOptions } from '../robot-configuration.ts';
import { checkAudit } from './check-audit.ts';
import { checkMonotonicClock, checkTimeOfDay, type ServerTime } from './check-clock.ts';
import type { Configuration } from './check-configuration.ts';
import { checkRecording, checkSharedMemory, checkState } from './check-files.ts';
import { checkAddresses, checkUdpPorts, judgeIce } from './check-ice.ts';
import {
  checkMemory,
  checkNode,
  checkProcessor,
  checkSocketBuffers,
  judgeCodec,
  timeCodec,
} from './check-machine.ts';
import { judgeSignaling } from './check-signaling.ts';
import { judgeSound } from './check-sound.ts';
import { judgeClosedSource, judgeSource, trialSource } from './check-source.ts';
import { checkStops } from './check-stops.ts';
import { devicesOf, judgeUnitDevices, serviceUnit } from './check-unit.ts';
import { judgeVideo } from './check-video.ts';
import { type Check, type Result, warn } from './finding.ts';
import type { Host } from './host.ts';
import { iceTargets, probeIce } from './ice-probe.ts';
import { timeEncoders, trySound } from './media-trial.ts';
import { checkRos, graphsOf } from './ros-probe.ts';
import { findRunningRobot, judgeRunning, type RunningRobot } from './running-robot.ts';
import { askTime, probeSignaling } from './signaling-probe.ts';
import { trySource } from './source-trial.ts';

/** How long the doctor waits for others, ms. */
export interface DoctorTimes {
  /** For the answer of a server. */
  answerMs: number;
  /** For a camera's program, at most. */
  producerMs: number;
  /** Watching the source. */
  watchMs: number;
}

const TIMES: DoctorTimes = { answerMs: 5000, producerMs: 3000, watchMs: 2000 };
/**
 * Time that a check may take in addition to its waits, ms. Chosen: threads start and modules load in it on a
 * slow computer.
 */
const SLACK_MS = 2000;

const now = () => performance.now();

/** Checks that need no configuration. */
export function machineChecks(host: Host, dds: boolean): Check[] {
  const quick = (name: string, run: Check['run']): Check => ({ name, withinMs: SLACK_MS, run });
  return [
    quick('node', () => checkNode(process.versions.node, process.platform, process.arch)),
    quick('processor', () => {
      const all = cpus();
      const load = { cores: all.length, model: all[0]?.model.trim() ?? 'unknown', load: loadavg()[0] ?? 0 };
      return checkProcessor(host, load);
    }),
    { name: 'codec', withinMs: 20_000, run: async () => judgeCodec(await timeCodec(now)) },
    quick('memory', () => checkMemory(host)),
    quick('socket buffers', () => checkSocketBuffers(host, dds)),
    quick('clock', () => checkMonotonicClock(host, now)),
    quick('network', () => checkAddresses(networkInterfaces())),
  ];
}

export function configurationCheck({ results }: Configuration): Check {
  return { name: 'configuration', withinMs: SLACK_MS, run: () => results };
}

/** What earlier checks have found and later ones use. */
interface Found {
  running: RunningRobot;
  serviceServers: readonly IceServer[];
  time: ServerTime | null;
}

/** Checks of a configured robot. They run in this order, because later ones use the results of earlier ones. */
export function robotChecks(robot: RobotOptions, values: RobotOptionValues, times = TIMES): Check[] {
  const found: Found = { running: { state: 'stands' }, serviceServers: [], time: null };
  return [
    ...serviceChecks(robot, values, found, times),
    ...networkChecks(robot, found, times),
    ...partChecks(robot, values, found, times),
    ...sourceChecks(robot, found, times),
    ...fileChecks(robot, found),
  ];
}

/** Whether the robot runs already, and what the signaling service says. */
function serviceChecks(
  robot: RobotOptions,
  { adminHost, adminPort }: RobotOptionValues,
  found: Found,
  { answerMs }: DoctorTimes,
): Check[] {
  return [
    {
      name: 'robot',
      withinMs: answerMs + SLACK_MS,
      run: async () => {
        found.running = await findRunningRobot(adminHost, adminPort, answerMs);
        return judgeRunning(found.running, adminHost, adminPort);
      },
    },
    {
      name: 'signaling',
      withinMs: 2 * answerMs + SLACK_MS,
      run: async () => {
        const target = { id: robot.id, name: robot.name, ...robot.signaling };
        const answer = await probeSignaling(target, answerMs, now);
        if (answer.outcome === 'welcome') found.serviceServers = answer.iceServers;
        if (answer.outcome === 'welcome' || answer.outcome === 'refused')
          found.time = await askTime(target, answerMs, Date.now);
        return judgeSignaling(target.url, robot.id, answer, found.running.state === 'runs', Date.now());
      },
    },
    { name: 'clock', withinMs: SLACK_MS, run: () => checkTimeOfDay(found.time) },
  ];
}

function networkChecks(robot: RobotOptions, found: Found, { answerMs }: DoctorTimes): Check[] {
  return [
    {
      name: 'STUN and TURN',
      withinMs: 2 * answerMs + SLACK_MS,
      run: async () => {
        const targets = iceTargets([...found.serviceServers, ...robot.iceServers]);
        const probed = await Promise.all(
          targets.map(async (target) => ({ target, answer: await probeIce(target, answerMs, now) })),
        );
        return judgeIce(probed, robot.icePolicy);
      },
    },
    {
      name: 'network',
      withinMs: SLACK_MS,
      run: () =>
        found.running.state === 'runs' ? [] : checkUdpPorts(robot.portRange ?? null, mostSessions(robot)),
    },
  ];
}

/** What else runs on this machine: other programs, the ROS graph, stops, the service manager. */
function partChecks(
  robot: RobotOptions,
  { topics }: RobotOptionValues,
  found: Found,
  { answerMs }: DoctorTimes,
): Check[] {
  const runs = () => found.running.state === 'runs';
  return [
    {
      name: 'shared memory',
      withinMs: SLACK_MS,
      run: () =>
        robot.sensors.flatMap(({ capture }) => checkSharedMemory(capture.source, robot.sink, runs())),
    },
    {
      name: 'ROS',
      withinMs: 4 * answerMs + SLACK_MS,
      run: async () => {
        const own = runs() && robot.sink.kind === 'ros' ? 1 : 0;
        const graphs = graphsOf(robot, topics);
        return (
          await Promise.all(graphs.map(({ graph, table }) => checkRos(graph, table, own, answerMs)))
        ).flat();
      },
    },
    {
      name: 'stops',
      withinMs: answerMs + 10_000,
      run: () =>
        checkStops(robot.stops, runs(), {
          isTerminal: process.stdin.isTTY === true,
          wait: (ms) => new Promise((resolve) => setTimeout(resolve, ms)),
        }),
    },
    {
      name: 'service',
      withinMs: answerMs + SLACK_MS,
      run: async () => {
        const devices = devicesOf(robot);
        return devices.length === 0 ? [] : judgeUnitDevices(devices, await serviceUnit(answerMs));
      },
    },
  ];
}

function sourceChecks(robot: RobotOptions, found: Found, times: DoctorTimes): Check[] {
  const runs = () => found.running.state === 'runs';
  return [
    ...robot.sensors.map(({ name, capture }, i) => ({
      name: i === 0 ? 'source' : `source (${name})`,
      withinMs: 20_000,
      run: () => checkSource(capture, robot, runs(), times),
    })),
    {
      name: 'video',
      withinMs: 30_000,
      run: async () => judgeVideo(await timeEncoders(), robot.videos),
    },
    {
      name: 'sound',
      withinMs: 20_000,
      run: async () => judgeSound(await trySound(robot.sound), runs()),
    },
  ];
}

function fileChecks(robot: RobotOptions, found: Found): Check[] {
  return [
    {
      name: 'recording',
      withinMs: SLACK_MS,
      run: () => (found.running.state === 'runs' ? [] : checkRecording(robot.record)),
    },
    { name: 'state', withinMs: SLACK_MS, run: () => checkState(robot) },
    { name: 'audit log', withinMs: 20_000, run: () => checkAudit(robot.audit?.path) },
  ];
}

async function checkSource(
  capture: CaptureOptions,
  { sink, base }: RobotOptions,
  robotRuns: boolean,
  { producerMs, watchMs }: DoctorTimes,
): Promise<Result[]> {
  const { source } = capture;
  if (robotRuns && source.kind === 'shm' && source.layout === 'reference')
    return [
      warn(
        'not tried: the running robot would lose frames',
        'stop it and run the doctor again, or see source_faults on its /metrics',
      ),
    ];
  try {
    const trial = await trySource({ ...capture, source: trialSource(source, producerMs) }, watchMs);
    return judgeSource(trial, sink.kind === 'base' && base === null, capture.picturesOfCloud);
  } catch (error) {
    return judgeClosedSource(source, error as Error);
  }
}

/** With grants, sessions that have shown none yet have places of their own. */
function mostSessions({ places, grantKeys }: Pick<RobotOptions, 'places' | 'grantKeys'>): number {
  return places.most + (grantKeys === undefined ? 0 : ANTEROOM);
}
