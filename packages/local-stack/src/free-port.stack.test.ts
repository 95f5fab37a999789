import { createServer } from 'node:net';
import { describe, expect, it } from 'vitest';
import { freePorts, isPortFree } from './free-port.ts';

describe('freePorts', () => {
  it('gives no port twice, also where several are looked for at once, and none of those of connections', async () => {
    const ports = (await Promise.all([freePorts(20), freePorts(20), freePorts(1)])).flat();
    expect(new Set(ports).size).toBe(41);
    for (const port of ports) expect(port).toSatisfy((each: number) => each >= 20_000 && each < 32_000);
  });

  it('leaves out ports that are in use', async () => {
    const [first = 0] = await freePorts(1);
    const server = createServer();
    await new Promise<void>((resolve) => server.listen(first + 1, '127.0.0.1', resolve));
    expect(await isPortFree(first + 1)).toBe(false);
    expect(await freePorts(2)).not.toContain(first + 1);
    await new Promise((resolve) => server.close(resolve));
    expect(await isPortFree(first + 1)).toBe(true);
  });
});
