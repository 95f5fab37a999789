/** `farpoint-robot release`: somebody at the robot releases the emergency stop of the robot that runs. */

import { keptRun, type Run } from '../../motion/drive/estop-journal.ts';
import { ReleaseRequest } from '../../motion/drive/release-request.ts';
import { checkConfiguration } from '../doctor/check-configuration.ts';
import type { CommandRim } from './init.ts';

const HELP = `farpoint-robot release [any option of farpoint-robot]

Releases the emergency stop of the robot that runs on this machine with this id and state folder (--id, --state-dir,
or --config), for a robot whose operators cannot do so, such as those of the reference system. Run it as the robot's user or
as root, where you see the robot. The robot moves only after its driver has let go of the stick once.

It releases what whoever drives might release: not what a stop at the robot holds, nor what --estop-release leaves to others.

Exit code: 0 if the emergency stop is released, 1 if not, 2 for a mistake in the options.
`;

/**
 * The robot looks for requests every 0.25 s, unless it is busy: twelve looks, ms. Chosen: who stands before
 * the console waits no longer.
 */
const MOST_WAIT_MS = 3000;
/** Between two looks for the answer, ms. Chosen: it seems immediate. */
const LOOK_MS = 50;

export interface ReleaseRim extends CommandRim {
  readonly env: Readonly<Record<string, string | undefined>>;
  /** Resolves after so many ms. */
  wait?: (ms: number) => Promise<unknown>;
}

/** @returns the exit code */
export async function release(
  argv: readonly string[],
  { stdout, stderr, env, wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms)) }: ReleaseRim,
): Promise<number> {
  const refuse = (detail: string, code = 1): number => {
    stderr.write(`farpoint-robot release: ${detail}\n`);
    return code;
  };
  if (argv.includes('--help') || argv.includes('-h')) {
    stdout.write(HELP);
    return 0;
  }
  const { robot, results } = checkConfiguration(argv, env);
  if (robot === null) return refuse(results.map(({ detail }) => detail).join('\n'), 2);
  const { id, stateFolder } = robot;
  const run = () => keptRun(stateFolder, id);
  const before = run();
  if (before === null || !before.running)
    return refuse(`no robot with the id ${id} and the state folder ${stateFolder} runs`);
  if (isClear(before)) {
    stdout.write('The emergency stop is not latched.\n');
    return 0;
  }
  const request = new ReleaseRequest(stateFolder, id);
  try {
    request.make();
    for (let waitedMs = 0; waitedMs < MOST_WAIT_MS; waitedMs += LOOK_MS) {
      await wait(LOOK_MS);
      const now = run();
      if (now === null || !isClear(now)) continue;
      stdout.write(`Released: ${id} moves when its driver has let go of the stick once.\n`);
      return 0;
    }
    // Not to be found by a robot that starts later.
    const isTaken = !request.take();
    return refuse(
      isTaken ? refusal(run() ?? before) : `the robot ${id} does not answer: it has ended or hangs`,
    );
  } catch (error) {
    return refuse(
      `${stateFolder} cannot be written: ${(error as Error).message}; run it as the robot’s user`,
    );
  }
}

function isClear({ latchedBy, heldBy }: Run): boolean {
  return latchedBy === null && heldBy.length === 0;
}

function refusal({ heldBy }: Run): string {
  return heldBy.length > 0
    ? `a stop at the robot holds it, which is released there: ${heldBy.join(', ')}`
    : 'the robot has not released it: its log says why';
}
