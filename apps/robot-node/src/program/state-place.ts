/**
 * Whether what the robot remembers outlives its container: its emergency stop, its key and revoked grants. Linux only;
 * elsewhere nothing is said against a place.
 */
import { existsSync, readFileSync, realpathSync } from 'node:fs';
import { dirname, isAbsolute, resolve } from 'node:path';
import type { Logger } from '@farpoint/service';
import type { RobotOptions } from './robot-configuration.ts';

/** Why a place is forgotten. */
export type Fleeting =
  | 'layer' // of a container: gone with it
  | 'volume' // without a name: the next container gets another one
  | 'memory'; // gone when the machine or the container restarts

export interface StatePlace {
  path: string;
  fleeting: Fleeting;
}

const WORDS: Readonly<Record<Fleeting, string>> = {
  layer: 'in the container’s own layer, and is lost with the container',
  volume: 'in a volume without a name, and the next container gets another one',
  memory: 'in memory, and is lost at the next restart',
};
export const STATE_REMEDY =
  'keep it in a folder of the machine or a named volume: docker run -v /var/lib/farpoint:/var/lib/farpoint';

const LAYERS = /^(overlay|aufs|fuse\.fuse-overlayfs|fuse-overlayfs)$/;
const IN_MEMORY = /^(tmpfs|ramfs)$/;
/** Docker and Podman name a volume that nobody named by 64 digits. */
const NAMELESS = /\/volumes\/[0-9a-f]{64}\/_data(\/|$)/;

interface Mount {
  /** The part of its file system that is mounted. */
  root: string;
  at: string;
  type: string;
}

/**
 * @param mounts text of /proc/self/mountinfo
 * @param path absolute, without links
 * @param inContainer whether an engine has marked this file system as a container's
 * @returns `null` if it is kept
 */
export function fleetingPlace(mounts: string, path: string, inContainer: boolean): Fleeting | null {
  let found: Mount | null = null;
  for (const line of mounts.split('\n')) {
    const mount = parseMount(line);
    // Of several mounts on one place, the last one counts.
    if (mount !== null && isWithin(path, mount.at) && mount.at.length >= (found?.at.length ?? 0))
      found = mount;
  }
  if (found === null) return null;
  if (IN_MEMORY.test(found.type)) return 'memory';
  if (found.at === '/' && (inContainer || LAYERS.test(found.type))) return 'layer';
  return NAMELESS.test(found.root) ? 'volume' : null;
}

/** The robot's files that would be forgotten. */
export function fleetingState({
  stateFolder,
  robotKey,
  audit,
}: Pick<RobotOptions, 'stateFolder' | 'robotKey' | 'audit'>): StatePlace[] {
  let mounts: string;
  try {
    mounts = readFileSync('/proc/self/mountinfo', 'utf8');
  } catch {
    return [];
  }
  const inContainer = existsSync('/.dockerenv') || existsSync('/run/.containerenv');
  const inFolder = (path: string) => isWithin(resolve(path), resolve(stateFolder));
  const others = [robotKey, ...(audit === undefined ? [] : [audit.path])].filter((path) => !inFolder(path));
  return [stateFolder, ...others].flatMap((path) => {
    const fleeting = fleetingPlace(mounts, existingPlace(path), inContainer);
    return fleeting === null ? [] : [{ path, fleeting }];
  });
}

export function placeText({ path, fleeting }: StatePlace): string {
  return `${path} is ${WORDS[fleeting]}`;
}

/** A robot that forgets starts unlatched after a stop, and believes grants that were revoked. */
export function warnOfFleetingState(options: Parameters<typeof fleetingState>[0], log: Logger): void {
  for (const place of fleetingState(options))
    log.warn(
      { remedy: STATE_REMEDY },
      `the robot will forget its emergency stop, its key or revoked grants: ${placeText(place)}`,
    );
}

/** The path without links, or that of the folder in which it will be made. */
function existingPlace(path: string): string {
  for (let at = isAbsolute(path) ? path : resolve(path); ; at = dirname(at)) {
    try {
      return realpathSync(at);
    } catch {
      if (at === dirname(at)) return at;
    }
  }
}

function isWithin(path: string, folder: string): boolean {
  return folder === '/' || path === folder || path.startsWith(`${folder}/`);
}

/** 36 35 98:0 /mnt1 /mnt2 rw,noatime master:1 - ext3 /dev/root rw: see proc_pid_mountinfo(5). */
function parseMount(line: string): Mount | null {
  const [before = '', after = ''] = line.split(' - ');
  const [, , , root, at] = before.split(' ');
  const type = after.split(' ')[0];
  return root === undefined || at === undefined || !type
    ? null
    : { root: unescaped(root), at: unescaped(at), type };
}

/** Spaces and the like are written as octal numbers. */
function unescaped(text: string): string {
  return text.replaceAll(/\\([0-7]{3})/g, (_, digits: string) =>
    String.fromCharCode(Number.parseInt(digits, 8)),
  );
}
