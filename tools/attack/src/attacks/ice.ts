import { createSocket } from 'node:dgram';
import { once } from 'node:events';
import { connectivityCheck, strayResponse } from '@farpoint/webrtc/testing';
import { Message } from 'werift';
import { attacks } from '../attack.ts';
import { mustHold, pause } from '../harm.ts';
import { Noise } from '../noise.ts';
import { ROBOT, type Scene } from '../scene.ts';

/** More than an agent sends while it looks for a path. */
const MAX_CHECKS = 60;

/** As the robot expects it: its fragment first. */
function username({ driver }: Scene): string {
  const { remoteUsername, localUsername } = driver.connection;
  return `${remoteUsername}:${localUsername}`;
}

/** A STUN message with these bytes for attributes. */
function stun(type: number, attributes: Uint8Array, length = attributes.length): Buffer {
  const header = Buffer.alloc(20, 7);
  header.writeUInt16BE(type, 0);
  header.writeUInt16BE(length, 2);
  header.writeUInt32BE(0x2112a442, 4);
  return Buffer.concat([header, attributes]);
}

/** On connectivity checks and candidates. What a stranger sends must not even be answered. */
export const iceAttacks = attacks('ice', {
  'check without MESSAGE-INTEGRITY': (scene) =>
    scene.unanswered(() => scene.fromStranger(connectivityCheck({ username: username(scene) }))),
  'check with a wrong password': (scene) =>
    scene.unanswered(() =>
      scene.fromStranger(
        connectivityCheck({ username: username(scene), password: 'a password of 22 bytes' }),
      ),
    ),
  'check for an unknown session': (scene) =>
    scene.unanswered(() => scene.fromStranger(connectivityCheck({ username: 'none:none', password: 'x' }))),
  'check with the driver’s address, unauthenticated': (scene) =>
    scene.asDriver(connectivityCheck({ username: username(scene) })),
  'thousand nominations of a stranger’s path': async (scene) => {
    const check = connectivityCheck({ username: username(scene) });
    await scene.unanswered(() => scene.fromStranger(...new Array<Buffer>(1000).fill(check)));
  },
  'success response to nobody’s request': (scene) => scene.fromBoth(strayResponse()),
  'role conflict to nobody’s request': (scene) =>
    scene.fromBoth(new Message(1, 0x110).setAttribute('ERROR-CODE', [487, 'Role Conflict']).bytes),
  indications: (scene) => scene.fromBoth(stun(0x0011, new Uint8Array(0)), stun(0x0016, new Uint8Array(40))),
  'other methods: allocate, refresh, permissions': (scene) =>
    scene.unanswered(() =>
      scene.fromStranger(...[3, 4, 8, 9].map((method) => stun(method, new Uint8Array(0)))),
    ),
  'attributes beyond the message': (scene) =>
    scene.fromBoth(
      stun(1, Uint8Array.of(0, 6, 0xff, 0xff)),
      stun(1, Uint8Array.of(0, 6, 0, 9, 1)),
      stun(1, Uint8Array.of(0)),
    ),
  'length of another message': (scene) =>
    scene.fromBoth(stun(1, new Uint8Array(8), 65_535), stun(1, new Uint8Array(8), 0)),
  'user name of 1,300 bytes': (scene) =>
    scene.fromBoth(connectivityCheck({ username: `${username(scene)}${'x'.repeat(1300)}`, password: 'x' })),
  'names of JavaScript’s own': (scene) =>
    scene.fromBoth(
      ...['__proto__', 'constructor', 'hasOwnProperty', 'toString'].map((name) =>
        connectivityCheck({ username: `${name}:x`, password: 'undefined' }),
      ),
    ),
  'channel data as from a relay': (scene) =>
    scene.fromBoth(Buffer.from([0x40, 0, 0, 4, 1, 2, 3, 4]), Buffer.from([0x7f, 0xff, 0xff, 0xff])),
  'random STUN messages': async (scene) => {
    const noise = new Noise(3);
    for (let n = 0; n < 500; n++)
      await scene.fromBoth(stun(noise.below(0x4000), noise.bytes(noise.below(400))));
  },
  'datagrams of 0 to 20 bytes, all first bytes': async (scene) => {
    for (let first = 0; first < 256; first++) await scene.fromBoth(Buffer.alloc(first % 21, first));
  },
  'candidates of a third party, to make the robot send to it': async (scene) => {
    const victim = createSocket('udp4').bind(0, '127.0.0.1');
    await once(victim, 'listening');
    scene.later(() => victim.close());
    let received = 0;
    victim.on('message', () => received++);
    const guest = await scene.asker(ROBOT);
    const { port } = victim.address();
    await guest.until(({ type }) => type === 'session.offer');
    for (let n = 0; n < 100; n++) {
      guest.client.onCandidate?.({
        candidate: `candidate:${n} 1 udp 2122260223 127.0.0.1 ${port} typ host`,
        sdpMid: '0',
        sdpMLineIndex: 0,
      });
    }
    await pause(2000);
    mustHold(received <= MAX_CHECKS, `a third party got ${received} datagrams`);
  },
  'candidates that are none': async (scene) => {
    const guest = await scene.asker(ROBOT);
    await guest.until(({ type }) => type === 'session.offer');
    for (const candidate of ['', 'x', 'candidate:', `candidate:1 1 udp 1 ${'9'.repeat(300)} 1 typ host`]) {
      guest.client.onCandidate?.({ candidate, sdpMid: '0', sdpMLineIndex: 0 });
    }
    for (const host of ['::', '0.0.0.0', '255.255.255.255', '224.0.0.1', 'evil.example', '127.0.0.1']) {
      guest.client.onCandidate?.({
        candidate: `candidate:1 1 udp 2122260223 ${host} 9 typ host`,
        sdpMid: '0',
        sdpMLineIndex: 0,
      });
    }
    await pause(300);
  },
});
