/** Where the robot stores state that must outlive the process. */
import { homedir } from 'node:os';
import { join } from 'node:path';
import {
  defineOption,
  folderFault,
  type OptionTable,
  type OptionValues,
  optionGroup,
  schema,
} from '@farpoint/service';

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

/** What is recorded about who did what. */
export const auditOptions = optionGroup('audit', {
  auditLog: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    file: 'log',
    help: 'record sessions, leases, emergency stops and refusals in this file, in a chain that shows every change (`farpoint-robot audit verify`); default: not recorded',
  }),
  auditMax: defineOption({
    schema: schema.size({ min: 100_000 }),
    default: 64e6,
    argument: 'SIZE',
    file: 'max',
    help: 'audit: begin a new file when the old one has this size; the old one is renamed and kept',
  }),
});
