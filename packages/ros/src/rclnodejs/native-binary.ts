/**
 * If rclnodejs finds no loadable binary, it rebuilds itself, which takes minutes. A robot that starts must not do that,
 * so this checks for a binary first.
 */
import { existsSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { arch, platform } from 'node:os';
import { dirname, join } from 'node:path';
import { RosFault } from '../fault.ts';
import type { Environment } from './environment.ts';

const REMEDY = 'run `npm rebuild rclnodejs` where it is installed, with the same ROS sourced';

/** The paths it searches, best match for this system first. @param osRelease text of os-release(5) */
export function binaryPaths(folder: string, env: Environment, osRelease: string): string[] {
  const codename = /^VERSION_CODENAME=(.*)$/m.exec(osRelease)?.[1]?.trim() ?? '';
  const name = `${env.ROS_DISTRO}-${codename}-${arch()}-node-rclnodejs.node`;
  return [
    join(folder, 'prebuilds', `${platform()}-${arch()}`, name),
    join(folder, 'build', 'Release', 'rclnodejs.node'),
  ];
}

/**
 * @param entry of {@link findRclnodejs}
 * @throws {RosFault} `unavailable`: there is no binary, or it does not load
 */
export function checkBinary(entry: string, env: Environment): void {
  const require = createRequire(entry);
  const folder = dirname(require.resolve('rclnodejs/package.json'));
  const osRelease = existsSync('/etc/os-release') ? readFileSync('/etc/os-release', 'utf8') : '';
  const path = binaryPaths(folder, env, osRelease).find((each) => existsSync(each));
  if (path === undefined)
    throw new RosFault('unavailable', 'rclnodejs has no binary for this ROS', { remedy: REMEDY });
  try {
    require(path);
  } catch (error) {
    const what = `rclnodejs’s binary cannot be loaded (${(error as Error).message})`;
    throw new RosFault('unavailable', what, { remedy: REMEDY, cause: error });
  }
}
