/** Where the robot stores state that must outlive the process. */
import { homedir } from 'node:os';
import { join } from 'node:path';
import { defineOption, type OptionTable, schema } from '@farpoint/service';

export const stateOptions = {
  stateDir: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'DIR',
    help: 'folder in which the robot stores its emergency stop and revoked grants across restarts; default: the service manager’s STATE_DIRECTORY, else ~/.local/state/farpoint',
  }),
} satisfies OptionTable;

/** @param env `STATE_DIRECTORY` as set by systemd.exec(5), `XDG_STATE_HOME` from the XDG base directories */
export function stateFolder(stateDir: string | null, env: NodeJS.ProcessEnv): string {
  if (stateDir !== null) return stateDir;
  const ofService = env.STATE_DIRECTORY?.split(':')[0];
  if (ofService) return ofService;
  return join(env.XDG_STATE_HOME || join(homedir(), '.local', 'state'), 'farpoint');
}
