import { once } from 'node:events';
import { connect, type Socket } from 'node:net';
import { PROTOCOL_VERSION } from '@farpoint/protocol';
import {
  hostileFrames,
  hostileHandshakes,
  hostileTexts,
  hugeTexts,
  protocolMessages,
} from '@farpoint/signaling/testing';
import { attacks } from '../attack.ts';
import { inTime, mustHold, pause, untilTrue } from '../harm.ts';
import { Noise } from '../noise.ts';
import { RawSocket } from '../raw-socket.ts';
import { ROBOT, type Scene } from '../scene.ts';

const PATHS = ['/robot', '/operator'] as const;
const operatorHello = { type: 'operator.hello', protocol: PROTOCOL_VERSION, name: 'e' };
const robotHello = (id: string, key = 'k') => ({
  type: 'robot.hello',
  protocol: PROTOCOL_VERSION,
  id,
  name: id,
  key,
});

async function open(scene: Scene, path: string): Promise<RawSocket> {
  const socket = await RawSocket.open(`${scene.stack.signalingUrl}${path}`);
  scene.later(() => socket.close());
  return socket;
}

async function operator(scene: Scene): Promise<RawSocket> {
  const socket = await open(scene, '/operator');
  socket.send(operatorHello);
  await socket.next('operator.welcome');
  return socket;
}

/** On both paths, before and after the hello. */
async function everywhere(scene: Scene, messages: readonly (string | Uint8Array)[]): Promise<void> {
  for (const path of PATHS) {
    for (const hello of [false, true]) {
      const socket = await open(scene, path);
      if (hello) socket.send(path === '/robot' ? robotHello('evil') : operatorHello);
      for (const message of messages) socket.send(message);
      await socket.handled();
      socket.close();
    }
  }
}

/** @param localAddress of this machine too, but not the address of the others */
function tcp(scene: Scene, request = '', localAddress = '127.0.0.9'): Socket {
  const socket = connect({ port: scene.stack.ports.signaling, host: '127.0.0.1', localAddress });
  socket.on('error', () => undefined);
  scene.later(() => socket.destroy());
  if (request !== '') socket.write(request);
  return socket;
}

/** On the service that introduces robots and operators. */
export const signalingAttacks = attacks('signaling', {
  'random bytes': (scene) => {
    const noise = new Noise(11);
    return everywhere(
      scene,
      Array.from({ length: 40 }, () => noise.bytes(noise.below(300))),
    );
  },
  'random text': (scene) => {
    const noise = new Noise(12);
    return everywhere(
      scene,
      Array.from({ length: 40 }, () => noise.bytes(noise.below(300)).toString('latin1')),
    );
  },
  'damaged messages of the protocol': (scene) => {
    const noise = new Noise(13);
    const damaged = Array.from({ length: 45 }, (_, n) => {
      const text = Buffer.from(JSON.stringify(protocolMessages[n % protocolMessages.length]));
      text[noise.below(text.length)] = 32 + noise.below(95);
      return text.toString();
    });
    return everywhere(scene, damaged);
  },
  'texts that crash services': (scene) => everywhere(scene, hostileTexts),
  'deeply nested JSON': (scene) => everywhere(scene, hugeTexts),
  'messages of 70 KB and 1 MB': async (scene) => {
    const socket = await operator(scene);
    socket.send('x'.repeat(70_000));
    await socket.next('error');
    socket.send('x'.repeat(1_000_000));
    await untilTrue(() => socket.closeCode === 1009, 'a message of 1 MB does not close the socket');
  },
  'frames that break RFC 6455': async (scene) => {
    for (const { bytes, code, what } of hostileFrames) {
      const socket = await operator(scene);
      const { _socket } = socket.socket as unknown as { _socket: Socket };
      _socket.write(Uint8Array.from(bytes));
      await untilTrue(() => socket.closeCode === code, `${what} does not close the socket with ${code}`);
    }
  },
  'wrong WebSocket handshakes': async (scene) => {
    for (const request of hostileHandshakes) {
      const socket = tcp(scene, request);
      const [answer] = await inTime(once(socket, 'data'), 'a wrong handshake gets no answer');
      mustHold(/^HTTP\/1\.1 4\d\d /.test(String(answer)), 'a wrong handshake is accepted');
    }
  },
  'flood of pings whose answers are not read': async (scene) => {
    const socket = await operator(scene);
    for (let n = 0; n < 500; n++) socket.socket.ping();
    await untilTrue(() => socket.closeCode !== null, 'a flood of pings is not cut off');
  },
  'flood of valid messages': async (scene) => {
    const socket = await operator(scene);
    for (let n = 0; n < 3000; n++) socket.send({ type: 'session.open', robotId: 'nowhere' });
    await untilTrue(() => socket.closeCode !== null, 'a flood of messages is not cut off');
  },
  'messages before the hello, and two hellos': async (scene) => {
    const early = await open(scene, '/operator');
    early.send({ type: 'session.open', robotId: ROBOT });
    await early.next('error');
    const twice = await operator(scene);
    twice.send(operatorHello);
    await twice.next('error');
  },
  'takes the name of a connected robot': async (scene) => {
    const thief = await open(scene, '/robot');
    thief.send(robotHello(ROBOT, 'another-key'));
    const { code } = await thief.next('error');
    mustHold(code === 'robot-id-taken', `${code}, not robot-id-taken`);
  },
  'ends the driver’s session': async (scene) => {
    const thief = await operator(scene);
    thief.send({ type: 'session.close', session: scene.driver.session });
    mustHold((await thief.next('error')).code === 'unknown-session', 'somebody else’s session was found');
  },
  'answers for the driver, and sends candidates': async (scene) => {
    const thief = await operator(scene);
    const { session } = scene.driver;
    thief.send({ type: 'session.answer', session, sdp: 'v=0' });
    await thief.next('error');
    const candidate = {
      candidate: 'candidate:1 1 udp 1 127.0.0.1 9 typ host',
      sdpMid: '0',
      sdpMLineIndex: 0,
    };
    thief.send({ type: 'session.candidate', session, candidate });
    await thief.next('error');
  },
  'takes over the driver’s session with a wrong key': async (scene) => {
    const thief = await operator(scene);
    const { session } = scene.driver;
    thief.send({ type: 'session.resume', session, robotId: ROBOT, resumeKey: 'w'.repeat(22) });
    mustHold((await thief.next('error')).code === 'wrong-resume-key', 'the session was not refused');
  },
  'another robot ends the driver’s session': async (scene) => {
    const robot = await open(scene, '/robot');
    robot.send(robotHello('evil-robot'));
    await robot.next('robot.welcome');
    robot.send({ type: 'session.close', session: scene.driver.session });
    mustHold((await robot.next('error')).code === 'unknown-session', 'somebody else’s session was found');
    robot.send({ type: 'session.offer', session: scene.driver.session, sdp: 'v=0' });
    await robot.next('error');
  },
  'answers that are no SDP': async (scene) => {
    for (const sdp of ['v=0', 'x', `v=0\r\n${'a=x\r\n'.repeat(5000)}`, 'm=audio 9 x\r\n']) {
      const socket = await operator(scene);
      socket.send({ type: 'session.open', robotId: ROBOT });
      const { session } = await socket.next('session.offer');
      socket.send({ type: 'session.answer', session, sdp });
      await socket.next('session.closed');
      socket.close();
    }
  },
  'requests for all places, never answered': async (scene) => {
    const socket = await operator(scene);
    for (let n = 0; n < 16; n++) socket.send({ type: 'session.open', robotId: ROBOT });
    await pause(200);
    const begun = performance.now();
    await scene.guest();
    mustHold(performance.now() - begun < 5000, 'an operator was kept out for 5 s');
  },
  'four hundred silent connections': async (scene) => {
    const silent = Array.from({ length: 400 }, () => tcp(scene));
    await inTime(
      once(silent[399] as Socket, 'connect').catch(() => undefined),
      '',
      1000,
    ).catch(() => undefined);
    await operator(scene);
  },
  'requests that never end': async (scene) => {
    for (let n = 0; n < 50; n++) tcp(scene, `GET / HTTP/1.1\r\nHost: x\r\nX-${n}: `);
    await operator(scene);
  },
  'unknown paths and protocols': async (scene) => {
    for (const path of ['/', '/admin', '/%00', `/${'x'.repeat(2000)}`]) {
      await open(scene, path).then(
        () => mustHold(false, `a WebSocket at ${path}`),
        () => undefined,
      );
    }
    const future = await open(scene, '/operator');
    future.send({ ...operatorHello, protocol: 99 });
    mustHold((await future.next('error')).code === 'unsupported-protocol', 'protocol 99 is accepted');
  },
  'robot with a list of names for the others': async (scene) => {
    for (let n = 0; n < 30; n++) {
      const robot = await open(scene, '/robot');
      robot.send({ ...robotHello(`evil-${n}`), name: '\ud800<script>'.repeat(5) });
      await robot.handled();
    }
    await operator(scene);
  },
});
