import { type ChildProcess, spawn } from 'node:child_process';
import { run } from './run.ts';

/** iproute2 or the kernel refused. */
export class NetworkToolError extends Error {
  override readonly name = 'NetworkToolError';
}

/** `ip` and `tc`. @throws {NetworkToolError} with what they said */
export async function networkTool(program: 'ip' | 'tc', args: readonly string[]): Promise<void> {
  const { code, output } = await run(program, [...args]);
  if (code !== 0) throw new NetworkToolError(`${program} ${args.join(' ')}: ${output.trim()}`);
}

export interface Namespace {
  readonly name: string;
  readonly device: string;
  readonly address: string;
}

/** Two network namespaces with a veth pair between them. */
export class NamespacePair {
  readonly robot: Namespace;
  readonly operator: Namespace;

  private constructor(tag: string) {
    this.robot = { name: `farpoint-${tag}-robot`, device: `fp${tag}r`, address: '10.77.0.1' };
    this.operator = { name: `farpoint-${tag}-operator`, device: `fp${tag}o`, address: '10.77.0.2' };
  }

  /** @throws {NetworkToolError} leaving nothing behind */
  static async create(): Promise<NamespacePair> {
    const pair = new NamespacePair(String(process.pid));
    try {
      const { robot, operator } = pair;
      for (const { name } of [robot, operator]) await networkTool('ip', ['netns', 'add', name]);
      // Made inside: nothing ever shows in the machine's own namespace.
      await networkTool('ip', [
        ...['-n', robot.name, 'link', 'add', robot.device, 'type', 'veth'],
        ...['peer', 'name', operator.device, 'netns', operator.name],
      ]);
      for (const { name, device, address } of [robot, operator]) {
        await networkTool('ip', ['-n', name, 'address', 'add', `${address}/24`, 'dev', device]);
        await networkTool('ip', ['-n', name, 'link', 'set', device, 'up']);
        await networkTool('ip', ['-n', name, 'link', 'set', 'lo', 'up']);
      }
      return pair;
    } catch (error) {
      await pair.remove();
      throw error;
    }
  }

  /** Never throws. */
  async remove(): Promise<void> {
    for (const { name } of [this.robot, this.operator]) await run('ip', ['netns', 'delete', name]);
  }
}

/** Starts a program in a namespace; its output is ours unless it is told apart. */
export function spawnIn(
  { name }: Namespace,
  command: readonly string[],
  options: { cwd: string; env?: Record<string, string>; stdout: 'inherit' | 'pipe' },
): ChildProcess {
  return spawn('ip', ['netns', 'exec', name, ...command], {
    cwd: options.cwd,
    env: { ...process.env, ...options.env },
    stdio: options.stdout === 'inherit' ? 'inherit' : ['ignore', 'pipe', 'inherit'],
  });
}
