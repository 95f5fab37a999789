/** Where the robot stores state that must outlive the process. */
import { homedir } from 'node:os';
import { join } from 'node:path';
import { defineOption, folderFault, type OptionTable, type OptionValues, schema } from '@farpoint/service';

export const stateOptions = {
  stateDir: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'DIR',
    help: 'folder in which the robot stores its emergency stop and revoked grants across restarts; default: the service manager’s STATE_DIRECTORY, else ~/.local/state/farpoint',
  }),
} satisfies OptionTable;

/** The folder where the robot stores its state. @param refuse told why there can be none */
export function toStateFolder(
  { stateDir }: OptionValues<typeof stateOptions>,
  env: NodeJS.ProcessEnv,
  refuse: (key: 'stateDir', detail: string) => void,
): string {
  const folder = stateFolder(stateDir, env);
  const fault = folderFault(folder);
  if (fault !== null) refuse('stateDir', `must be a folder that can be written: ${folder} ${fault}`);
  return folder;
}

/** @param env `STATE_DIRECTORY` as set by systemd.exec(5), `XDG_STATE_HOME` from the XDG base directories */
export function stateFolder(stateDir: string | null, env: NodeJS.ProcessEnv): string {
  if (stateDir !== null) return stateDir;
  const ofService = env.STATE_DIRECTORY?.split(':')[0];
  if (ofService) return ofService;
  return join(env.XDG_STATE_HOME || join(homedir(), '.local', 'state'), 'farpoint');
}
