import { connect } from 'node:net';
import { attacks } from '../attack.ts';
import { mustHold, pause } from '../harm.ts';
import { ROBOT, type Scene } from '../scene.ts';

/** What a server answers to these bytes until it closes, or for a second. */
async function raw(port: number, request: string): Promise<string> {
  const socket = connect(port, '127.0.0.1');
  let answer = '';
  socket.on('error', () => undefined);
  socket.on('data', (data) => {
    answer += data;
  });
  socket.write(request, 'latin1');
  await Promise.race([new Promise((resolve) => socket.once('close', resolve)), pause(1000)]);
  socket.destroy();
  return answer;
}

const ports = ({ stack, bridge }: Scene) => [
  stack.ports.signaling,
  stack.ports.referenceRobot,
  Number(new URL(stack.robotAdminUrl(ROBOT)).port),
  Number(new URL(bridge.adminUrl).port),
];

async function atAll(scene: Scene, request: string): Promise<string[]> {
  return Promise.all(ports(scene).map((port) => raw(port, request)));
}

const get = (path: string, more = '') =>
  `GET ${path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n${more}\r\n`;

/** A WebSocket on the ports for peers, from a page that is not ours, is not opened. */
async function expectNoSocket({ stack }: Scene, headers: string, what: string): Promise<void> {
  const upgrade =
    'Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n';
  const { signaling, referenceRobot, referenceClient } = stack.ports;
  for (const [port, path] of [
    [signaling, '/operator'],
    [signaling, '/robot'],
    [referenceRobot, '/'],
    [referenceClient, '/'],
  ] as const) {
    const answer = await raw(port, `GET ${path} HTTP/1.1\r\n${headers}${upgrade}\r\n`);
    mustHold(answer.startsWith('HTTP/1.1 403'), `${what}: a socket at ${path} of port ${port}`);
  }
}

/** On every HTTP port: signaling, the reference port, and what robot and bridge tell about themselves. */
export const httpAttacks = attacks('http', {
  'paths that leave the folder': async (scene) => {
    for (const path of [
      '/../../../../etc/passwd',
      '/%2e%2e/%2e%2e/etc/passwd',
      '/..%5c..%5cetc/passwd',
      '/assets/..%2f..%2fetc/passwd',
    ]) {
      for (const answer of await atAll(scene, get(path)))
        mustHold(!answer.includes('root:'), `${path} is served`);
    }
  },
  'paths that are none': async (scene) => {
    for (const path of [
      '//',
      '/%',
      '/%00',
      '/%ff%fe',
      'http://[',
      '*',
      `/${'a'.repeat(8000)}`,
      '/?'.repeat(200),
    ]) {
      await atAll(scene, get(path));
    }
  },
  'headers of 64 KB, and ten thousand of them': async (scene) => {
    await atAll(scene, get('/healthz', `X: ${'x'.repeat(65_536)}\r\n`));
    await atAll(scene, get('/healthz', 'X: 1\r\n'.repeat(10_000)));
  },
  'methods other than GET': async (scene) => {
    for (const method of ['POST', 'PUT', 'DELETE', 'TRACE', 'OPTIONS', 'CONNECT', 'PATCH', 'LOCK']) {
      const request = `${method} /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nContent-Length: 1\r\n\r\nx`;
      for (const answer of await atAll(scene, request))
        mustHold(!/^HTTP\/1.1 5/.test(answer), `${method} fails`);
    }
  },
  'two lengths for one body': async (scene) => {
    const body = '0\r\n\r\nGET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n';
    const request = `POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 4\r\nTransfer-Encoding: chunked\r\n\r\n${body}`;
    for (const answer of await atAll(scene, request))
      mustHold(!answer.includes('farpoint_'), 'a second request was read');
  },
  'not HTTP at all': async (scene) => {
    await atAll(scene, '\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03');
    await atAll(scene, '\x00'.repeat(10_000));
    await atAll(scene, 'SSH-2.0-x\r\n');
  },
  'pages of other websites': async (scene) => {
    for (const origin of ['https://evil.example', 'http://127.0.0.1.evil.example', 'null', 'file://'])
      await expectNoSocket(scene, `Host: localhost\r\nOrigin: ${origin}\r\n`, origin);
  },
  'a name of the attacker’s that points to this machine': (scene) =>
    expectNoSocket(scene, 'Host: evil.example:3000\r\nOrigin: http://evil.example:3000\r\n', 'rebinding'),
  'health, metrics and pages by a name of the attacker’s': async ({ stack }) => {
    for (const path of ['/', '/healthz', '/metrics']) {
      const request = `GET ${path} HTTP/1.1\r\nHost: evil.example:3000\r\nConnection: close\r\n\r\n`;
      const answer = await raw(stack.ports.signaling, request);
      mustHold(answer.startsWith('HTTP/1.1 421'), `${path} is answered to another site`);
    }
  },
  'metrics through a proxy, whatever it says': async ({ stack }) => {
    for (const forwarded of [
      'X-Forwarded-For: 203.0.113.9',
      'Forwarded: for=203.0.113.9',
      'Via: 1.1 proxy',
    ]) {
      const answer = await raw(stack.ports.signaling, get('/metrics', `${forwarded}\r\n`));
      mustHold(answer.startsWith('HTTP/1.1 404'), 'metrics are told to others');
    }
  },
  'secrets in health and metrics': async (scene) => {
    for (const path of ['/healthz', '/metrics']) {
      for (const answer of await atAll(scene, get(path))) {
        mustHold(!answer.includes(scene.driver.lease), `${path} shows the lease`);
        mustHold(!answer.includes(scene.driver.session), `${path} shows the session`);
      }
    }
  },
});
