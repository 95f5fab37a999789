import { resolveOptions } from '@farpoint/service';
import { toRobotOptions } from '../robot-options.ts';
import { robotProgram } from '../robot-program.ts';

/** The options of a robot that is started with these arguments. @param file the text of its configuration, if it has one */
export function robotOf(argv: readonly string[], file: string | null = null) {
  const resolved = resolveOptions(robotProgram, { argv, env: {}, readFile: () => file });
  if (resolved.action !== 'run') throw new Error('printed');
  return toRobotOptions(resolved.values, resolved.where);
}
