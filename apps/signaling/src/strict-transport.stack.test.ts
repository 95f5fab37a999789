import { request } from 'node:https';
import { useFolder } from '@farpoint/service/testing/folder';
import { selfSigned } from '@farpoint/service/testing/self-signed';
import { expect, test } from 'vitest';
import { TestService } from './test-sockets.ts';

const folder = useFolder();

test('with TLS, browsers are told to use HTTPS only; not for localhost, nor without TLS', async () => {
  const { key: tlsKey, cert: tlsCert } = selfSigned(folder, 'hsts');
  const service = await TestService.start({ tlsKey, tlsCert });
  const plain = await TestService.start();
  try {
    const headerFor = (host: string, path = '/healthz') =>
      new Promise<string | undefined>((resolve, reject) => {
        const { signaling: port } = service.service.ports;
        const options = { port, path, host: '127.0.0.1', headers: { host }, rejectUnauthorized: false };
        request(options, (response) => {
          response.resume();
          resolve(response.headers['strict-transport-security']);
        })
          .on('error', reject)
          .end();
      });
    expect(await headerFor('teleop.example')).toBe('max-age=31536000');
    expect(await headerFor('teleop.example:8443', '/nothing-here')).toBe('max-age=31536000');
    for (const host of ['localhost:300', 'a.localhost', '127.0.0.1', '[::1]:300', 'no host'])
      expect(await headerFor(host), host).toBeUndefined();
    const response = await fetch(plain.http('/healthz'), { headers: { host: 'localhost' } });
    expect(response.headers.has('strict-transport-security')).toBe(false);
  } finally {
    await service.stop();
    await plain.stop();
  }
});
