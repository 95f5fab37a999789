/** Judges the trial of the source. */
import { fileFault } from '@farpoint/service';
import type { SourceOptions } from '../../sense/sources/open-source.ts';
import { fail, ok, type Result, warn } from './finding.ts';
import { asDoctor } from './ros-probe.ts';
import type { SourceTrial } from './source-trial.ts';

/** Fewer show no world that moves: as the page judges itself (display-meter.ts). */
const FEW_FRAMES_PER_SECOND = 5;
/**
 * The longest wait for ROS, ms: discovery precedes the first message. Twice the time that the probe gives
 * discovery (ros-probe.ts).
 */
const MOST_ROS_WAIT_MS = 6000;

/** The source's options for the trial, with waits for a camera's program of `mostWaitMs` at most. */
export function trialSource(source: SourceOptions, mostWaitMs: number): SourceOptions {
  if (source.kind === 'shm') return { ...source, waitMs: Math.min(source.waitMs, mostWaitMs) };
  if (source.kind !== 'ros') return source;
  return { ...source, graph: asDoctor(source.graph), waitMs: Math.min(source.waitMs, MOST_ROS_WAIT_MS) };
}

/**
 * @param wheelless whether velocities have no sink
 * @param picturesOfCloud whether the cloud's colour pictures are to be shown
 */
export function judgeSource(trial: SourceTrial, wheelless: boolean, picturesOfCloud = false): Result[] {
  const { description, frames, seconds, validPoints, workMs, faults } = trial;
  const { kind, width, height } = description;
  const grid = height > 1 ? `${width} × ${height}` : `up to ${description.capacity} points`;
  const results: Result[] = [];
  if (frames === 0) {
    results.push(
      fail(
        `${kind} (${grid}) opens but delivers no frame`,
        'does the camera’s program run, or does its topic have messages?',
      ),
    );
  } else {
    const rate = frames > 1 ? (frames - 1) / seconds : 0;
    const what = `${kind}, ${grid}: ${rate.toFixed(1)} frames/s, ${validPoints} valid points, ${workMs.toFixed(1)} ms of work each`;
    if (validPoints === 0) results.push(warn(what, 'is the lens covered, or is everything out of range?'));
    else if (rate < FEW_FRAMES_PER_SECOND)
      results.push(warn(what, 'too few to drive by: check the camera’s rate and the processor'));
    else results.push(ok(what));
  }
  for (const fault of faults) results.push(warn(`${kind}: ${fault}`, 'see the log of the camera’s program'));
  if (picturesOfCloud && description.camera === null)
    results.push(
      warn(
        'pictures.ofCloud has no effect: this source gives points, not images',
        'remove it, or use a source with a depth camera’s images',
      ),
    );
  if (wheelless)
    results.push(
      warn(
        'nobody can drive: this source has no wheels, and sink.kind is source',
        'set sink.kind, unless operators should only watch',
      ),
    );
  return results;
}

/** Judges a source that does not open. */
export function judgeClosedSource(source: SourceOptions, error: Error): Result[] {
  const detail = fileFault(error) ?? error.message;
  return [fail(`${source.kind}: ${detail}`, closedRemedy(source, error))];
}

function closedRemedy(source: SourceOptions, error: Error): string {
  const { message } = error;
  if (source.kind === 'shm') {
    if (/build:native|Linux/.test(message)) return 'build the addon: `pnpm build:native`';
    if (/ENOENT|no such file/i.test(message))
      return 'start the camera’s program, e.g. examples/zed_camera.py, with the same folder as the robot';
    if (/permi|EACCES/i.test(message))
      return 'run both as the same user, or give the file to a group that both are in';
    return 'restart the camera’s program; docs/shared-memory.md describes the layouts';
  }
  if (source.kind === 'ros') return '`farpoint-robot doctor` lists the topics; see also docs/ros.md';
  if (source.kind === 'sim' || source.kind === 'sim-lidar') return 'report this as a bug';
  if (/no such topic|not clouds/.test(message)) return 'set source.topic (--topic) to one of these topics';
  if (/no cloud/.test(message))
    return 'play another file or topic (--path, --topic): clouds are recorded while an operator watches';
  return `set source.path (--path) to ${PLAYED[source.kind]}`;
}

const PLAYED = {
  pcd: 'a PCD file or a folder of them',
  rgbd: 'a folder of colour and depth images in Open3D’s layout',
  recording: 'an MCAP file or a ROS 1 bag of version 2.0 (docs/recordings.md)',
} as const;
