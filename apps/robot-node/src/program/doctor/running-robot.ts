/** Asks the health endpoint whether the robot is running on this machine. */
import { createServer } from 'node:net';
import * as z from 'zod';
import { fail, ok, type Result } from './finding.ts';

const healthSchema = z.object({
  status: z.string(),
  uptimeSeconds: z.number(),
  checks: z.object({ operators: z.object({ detail: z.object({ connected: z.number() }) }) }),
});

export type RunningRobot =
  | { state: 'runs'; uptimeSeconds: number; operators: number; healthy: boolean }
  /** Another program uses the port. */
  | { state: 'taken' }
  /** The port cannot be opened at all. */
  | { state: 'refused'; detail: string }
  | { state: 'stands' };

export async function findRunningRobot(host: string, port: number, withinMs: number): Promise<RunningRobot> {
  if (port === 0) return { state: 'stands' };
  const bound = await tryBind(host, port);
  if (bound === null) return { state: 'stands' };
  if (bound !== 'EADDRINUSE') return { state: 'refused', detail: bound };
  const name =
    host === '0.0.0.0' ? '127.0.0.1' : host === '::' ? '[::1]' : host.includes(':') ? `[${host}]` : host;
  try {
    const answer = await fetch(`http://${name}:${port}/healthz`, { signal: AbortSignal.timeout(withinMs) });
    const { status, uptimeSeconds, checks } = healthSchema.parse(await answer.json());
    const operators = checks.operators.detail.connected;
    return { state: 'runs', uptimeSeconds, operators, healthy: status === 'ok' };
  } catch {
    return { state: 'taken' };
  }
}

export function judgeRunning(found: RunningRobot, host: string, port: number): Result[] {
  const place = `${host}:${port}`;
  switch (found.state) {
    case 'runs': {
      const what = `a robot runs here since ${found.uptimeSeconds} s, with ${found.operators} operators`;
      return [
        found.healthy
          ? ok(what)
          : fail(`${what}, and is not well`, `see http://${place}/healthz and its log`),
      ];
    }
    case 'taken':
      return [fail(`${place} is used by another program`, 'set admin.port, or stop that program')];
    case 'refused':
      return [
        fail(
          `${place} cannot be listened on: ${found.detail}`,
          'set admin.host and admin.port to what this machine has',
        ),
      ];
    case 'stands':
      if (port === 0)
        return [ok('health will be at a free port, since admin.port is 0; the log says which at the start')];
      return [ok(`no robot runs here; health will be at http://${place}/healthz`)];
  }
}

/** @returns `null` if the port is free, otherwise why it cannot be opened */
function tryBind(host: string, port: number): Promise<string | null> {
  return new Promise((resolve) => {
    const server = createServer();
    server.once('error', (error: NodeJS.ErrnoException) => resolve(error.code ?? error.message));
    server.listen(port, host, () => server.close(() => resolve(null)));
  });
}
