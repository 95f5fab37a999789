import { rootCommand } from './root-command.ts';
import { run } from './run.ts';

/**
 * Installs packages of the distribution, if apt and the necessary rights are available. The caller checks whether it
 * worked.
 */
export async function aptInstall(
  name: string | readonly string[],
  say: (line: string) => void,
): Promise<void> {
  const asRoot = rootCommand();
  if (asRoot === null || (await run('apt-get', ['--version'])).code !== 0) return;
  const names = typeof name === 'string' ? [name] : name;
  say(`installing the package${names.length === 1 ? '' : 's'} ${names.join(', ')}`);
  const [program = 'apt-get', ...args] = [...asRoot, 'apt-get'];
  await run(program, [...args, 'update']);
  await run(program, [...args, 'install', '-y', '--no-install-recommends', ...names], {
    env: { DEBIAN_FRONTEND: 'noninteractive' },
  });
}
