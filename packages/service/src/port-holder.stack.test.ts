import { type AddressInfo, createServer } from 'node:net';
import { expect, test } from 'vitest';
import { listeningInodes, portHolder, programName } from './port-holder.ts';

const TABLE = `  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode
   0: 0100007F:0BB8 00000000:0000 0A 00000000:00000000 00:00000000 00000000  1000        0 41230 1 0000 100 0 0 10 0
   1: 0100007F:0BB8 0100007F:C001 01 00000000:00000000 00:00000000 00000000  1000        0 41231 1 0000 20 4 30 10 -1
   2: 00000000:24B8 00000000:0000 0A 00000000:00000000 00:00000000 00000000     0        0 41232 1 0000 100 0 0 10 0
`;

test('counts only sockets that listen on the port', () => {
  expect(listeningInodes(TABLE, 3000)).toEqual(['41230']);
  expect(listeningInodes(TABLE, 9400)).toEqual(['41232']);
  expect(listeningInodes(TABLE, 3001)).toEqual([]);
  expect(listeningInodes('', 3000)).toEqual([]);
});

test('names programs as people start them', () => {
  expect(programName('/usr/bin/node\0/srv/apps/signaling/src/main.ts\0--port\0')).toBe(
    'node signaling/src/main.ts',
  );
  expect(programName('/usr/sbin/nginx: master process\0')).toBe('nginx:');
  expect(programName('python3\0-u\0server.py\0')).toBe('python3 server.py');
  expect(programName('')).toBe('a program');
});

test.skipIf(process.platform !== 'linux')('finds this process by the port on which it listens', async () => {
  const server = createServer();
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  const { port } = server.address() as AddressInfo;
  expect(portHolder(port)?.pid).toBe(process.pid);
  await new Promise((resolve) => server.close(resolve));
  expect(portHolder(port)).toBeNull();
});
