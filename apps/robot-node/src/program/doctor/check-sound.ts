/** Checks whether the configured microphone gives sound and the loudspeaker can be opened. */
import { fail, ok, type Result, warn } from './finding.ts';

/** What was tried with a device. */
export interface SoundTrial {
  device: 'microphone' | 'loudspeaker';
  /** Why it does not work, and what to do; `null` if it works. */
  fault: { sentence: string; remedy: string } | null;
  /** Time from the start to the first packet, or to when it could be played to, ms; `null` if neither happened. */
  startedMs: number | null;
}

/**
 * A device that takes longer is not ready when somebody begins to listen or to drive, ms. Chosen: who waits
 * so long speaks unheard.
 */
const SLOW_MS = 2000;

/** @param robotRuns the running robot may hold the devices */
export function judgeSound(trials: readonly SoundTrial[], robotRuns: boolean): Result[] {
  return trials.map(({ device, fault, startedMs }) => {
    const free = robotRuns ? 'stop the running robot, which may use it, and run the doctor again; else ' : '';
    if (fault !== null) return fail(fault.sentence, `${free}${fault.remedy}`);
    if (startedMs === null)
      return fail(`the ${device} did not start`, `${free}check that the device is connected`);
    const what = `the ${device} works: ready after ${(startedMs / 1000).toFixed(1)} s`;
    if (startedMs <= SLOW_MS) return ok(what);
    return warn(what, 'set GST_REGISTRY to a file that the robot may write');
  });
}
