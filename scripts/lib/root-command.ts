import { spawnSync } from 'node:child_process';

/**
 * Prefix for a command that needs root: `[]` as root, `['sudo', '-n']` if sudo asks for no password, otherwise
 * `null`.
 */
export function rootCommand(): string[] | null {
  if (process.getuid?.() === 0) return [];
  const asked = spawnSync('sudo', ['-n', 'true'], { stdio: 'ignore', timeout: 20_000 });
  return asked.status === 0 ? ['sudo', '-n'] : null;
}
