import { expect, it } from 'vitest';
import { startServer } from './server.ts';
import type { SignInDesk } from './sign-in-desk.ts';

it('knows browsers by their addresses, without the port that some gateways add, and only from named proxies', async () => {
  const seen: string[] = [];
  const desk = {
    begin: (_: URLSearchParams, { address }: { address: string }) => {
      seen.push(address);
      return Promise.resolve({ status: 429, text: 'enough' });
    },
  } as unknown as SignInDesk;
  const start = (trustProxy: string[]) =>
    startServer(desk, {
      ...{ host: '127.0.0.1', port: 0, url: 'https://issuer.example', trustProxy, now: () => 0 },
      onError: () => undefined,
    });
  const [behind, alone] = [await start(['loopback']), await start(['192.0.2.1'])];
  try {
    for (const { port } of [behind, alone])
      for (const forwarded of ['203.0.113.10:4711', '203.0.113.10:4712', 'forged, [2001:db8::1]:443'])
        await fetch(`http://127.0.0.1:${port}/sign-in`, { headers: { 'x-forwarded-for': forwarded } });
  } finally {
    await behind.close();
    await alone.close();
  }
  expect(seen).toEqual([
    ...['203.0.113.10', '203.0.113.10', '2001:db8::1'],
    ...['127.0.0.1', '127.0.0.1', '127.0.0.1'],
  ]);
});
