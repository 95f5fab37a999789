/** What came of trying the source. */
import { fileFault } from '@farpoint/service';
import type { SourceOptions } from '../capture/open-source.ts';
import { fail, ok, type Result, warn } from './finding.ts';
import { asDoctor } from './ros-probe.ts';
import type { SourceTrial } from './source-trial.ts';

const FEW_FRAMES_PER_SECOND = 5;
/** Longest that the doctor waits for a camera's program, ms. */
const MOST_WAIT_MS = 3000;
/** Discovery comes before the first message. */
const MOST_ROS_WAIT_MS = 6000;

/** The source as it is tried: nobody waits long for a producer. */
export function trialSource(source: SourceOptions): SourceOptions {
  if (source.kind === 'shm') return { ...source, waitMs: Math.min(source.waitMs, MOST_WAIT_MS) };
  if (source.kind !== 'ros') return source;
  return { ...source, graph: asDoctor(source.graph), waitMs: Math.min(source.waitMs, MOST_ROS_WAIT_MS) };
}

/**
 * @param wheelless whether velocities go nowhere
 * @param picturesOfCloud whether its colour pictures are to be shown
 */
export function judgeSource(trial: SourceTrial, wheelless: boolean, picturesOfCloud = false): Result[] {
  const { description, frames, seconds, validPoints, workMs, faults } = trial;
  const { kind, width, height } = description;
  const grid = height > 1 ? `${width} × ${height}` : `up to ${description.capacity} points`;
  const results: Result[] = [];
  if (frames === 0) {
    results.push(
      fail(
        `${kind} (${grid}) opens and gives no frame`,
        'does the camera’s program run, or its topic get messages?',
      ),
    );
  } else {
    const rate = frames > 1 ? (frames - 1) / seconds : 0;
    const what = `${kind}, ${grid}: ${rate.toFixed(1)} frames/s, ${validPoints} valid points, ${workMs.toFixed(1)} ms of work each`;
    if (validPoints === 0) results.push(warn(what, 'is the lens covered, or everything out of range?'));
    else if (rate < FEW_FRAMES_PER_SECOND)
      results.push(warn(what, 'that is few to drive by: check the camera’s rate, and the processor'));
    else results.push(ok(what));
  }
  for (const fault of faults)
    results.push(warn(`${kind}: ${fault}`, 'look into the log of the camera’s program'));
  if (picturesOfCloud && description.camera === null)
    results.push(
      warn(
        'pictures.ofCloud shows nothing: this source gives points, without pictures',
        'take it out, or take a source of a depth camera’s pictures',
      ),
    );
  if (wheelless)
    results.push(
      warn(
        'nobody can drive: this source has no wheels and sink.kind is source',
        'set sink.kind, unless it is only to be watched',
      ),
    );
  return results;
}

/** Of one that does not open. */
export function judgeClosedSource(source: SourceOptions, error: Error): Result[] {
  const detail = fileFault(error) ?? error.message;
  return [fail(`${source.kind}: ${detail}`, closedRemedy(source, error))];
}

function closedRemedy(source: SourceOptions, error: Error): string {
  const { message } = error;
  if (source.kind === 'shm') {
    if (/build:native|Linux/.test(message)) return 'build the addon: `pnpm build:native`';
    if (/ENOENT|no such file/i.test(message))
      return 'start the camera’s program, e.g. examples/zed_camera.py, and see that both name the same folder';
    if (/permi|EACCES/i.test(message))
      return 'run both as one user, or give the file to a group that both are in';
    return 'start the camera’s program anew; docs/shared-memory.md has the layouts';
  }
  if (source.kind === 'ros') return '`farpoint-robot doctor` lists the topics; docs/ros.md has the rest';
  if (source.kind === 'sim' || source.kind === 'sim-lidar') return 'report this';
  if (/no such topic|not clouds/.test(message)) return 'set source.topic (--topic) to one of those';
  if (/no cloud/.test(message))
    return 'play another file or topic (--path, --topic): clouds are recorded while an operator watches';
  return `set source.path (--path) to ${PLAYED[source.kind]}`;
}

const PLAYED = {
  pcd: 'a PCD file or a folder of them',
  rgbd: 'a folder of colour and depth pictures as Open3D lays it out',
  recording: 'an MCAP file or a ROS 1 bag of version 2.0 (docs/recordings.md)',
} as const;
