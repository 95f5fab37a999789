import { hostileTexts, hugeTexts, protocolMessages } from '@farpoint/signaling/testing';
import { attacks } from '../attack.ts';
import { mustHold, pause } from '../harm.ts';
import { Noise } from '../noise.ts';
import { RawSocket } from '../raw-socket.ts';
import type { Scene } from '../scene.ts';

async function open(scene: Scene, port: 'referenceRobot' | 'referenceClient'): Promise<RawSocket> {
  const socket = await RawSocket.open(`ws://127.0.0.1:${scene.stack.ports[port]}/`);
  scene.later(() => socket.close());
  return socket;
}

async function everywhere(scene: Scene, messages: readonly (string | Uint8Array)[]): Promise<void> {
  for (const port of ['referenceRobot', 'referenceClient'] as const) {
    const socket = await open(scene, port);
    for (const message of messages) socket.send(message);
    await socket.handled();
    socket.close();
  }
}

/** On the two ports for the reference system, which has no access control of its own. */
export const referenceAttacks = attacks('reference', {
  'random bytes': (scene) => {
    const noise = new Noise(21);
    return everywhere(
      scene,
      Array.from({ length: 100 }, () => noise.bytes(noise.below(300))),
    );
  },
  'texts that crash services': (scene) => everywhere(scene, [...hostileTexts, ...hugeTexts]),
  'messages of the other protocol': (scene) =>
    everywhere(
      scene,
      protocolMessages.map((message) => JSON.stringify(message)),
    ),
  'offers and leaves for another robot': async (scene) => {
    const evil = await open(scene, 'referenceRobot');
    evil.send({ type: 'register', name: 'Eve', sdpOffer: 'v=0' });
    const { robotId } = await evil.next('registered');
    for (let id = 0; id < Number(robotId); id++) {
      evil.send({ type: 'offer', robotId: id, sdpOffer: 'evil' });
      evil.send({ type: 'candidate', robotId: id, candidate: 'evil' });
      evil.send({ type: 'deregister', robotId: id });
    }
    await evil.handled();
    const client = await open(scene, 'referenceClient');
    client.send({ type: 'getRobots' });
    const { robots } = await client.next('robots');
    mustHold(!JSON.stringify(robots).includes('evil'), 'a robot has another one’s offer');
  },
  'registers five hundred times on one socket': async (scene) => {
    const evil = await open(scene, 'referenceRobot');
    for (let n = 0; n < 500; n++) evil.send({ type: 'register', name: `n${n}`, sdpOffer: 'v=0' });
    await pause(300);
  },
  'answers a robot that has offered nothing': async (scene) => {
    const client = await open(scene, 'referenceClient');
    for (const robotId of [-1, 0.5, 999, null, 'x']) client.send({ type: 'answer', robotId, sdpAnswer: 'x' });
    await client.handled();
  },
});
