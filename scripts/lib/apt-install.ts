import { rootCommand } from './root-command.ts';
import { run } from './run.ts';

/**
 * Installs a package of the distribution, if apt and the necessary rights are available. The caller checks whether it
 * worked.
 */
export async function aptInstall(name: string, say: (line: string) => void): Promise<void> {
  const asRoot = rootCommand();
  if (asRoot === null || (await run('apt-get', ['--version'])).code !== 0) return;
  say(`installing the package ${name}`);
  const [program = 'apt-get', ...args] = [...asRoot, 'apt-get'];
  await run(program, [...args, 'update']);
  await run(program, [...args, 'install', '-y', '--no-install-recommends', name], {
    env: { DEBIAN_FRONTEND: 'noninteractive' },
  });
}
