import { ReferenceRobot } from '@farpoint/conformance';
import { hostileTexts, hugeTexts } from '@farpoint/signaling/testing';
import { attacks } from '../attack.ts';
import { pause } from '../harm.ts';
import { Noise } from '../noise.ts';
import { RawSocket } from '../raw-socket.ts';
import type { Scene } from '../scene.ts';

const SOCKETS = ['control', 'telemetry', 'streaming'] as const;

async function everywhere(scene: Scene, messages: readonly (string | Uint8Array)[]): Promise<void> {
  for (const name of SOCKETS) {
    const socket = await RawSocket.open(`ws://127.0.0.1:${scene.bridge.ports[name]}/`);
    scene.later(() => socket.close());
    for (const message of messages) socket.send(message);
    await pause(100);
  }
}

/** On the bridge: from pages on its own machine, and from robots that signaling lists. */
export const bridgeAttacks = attacks('bridge', {
  'random bytes on its three sockets': (scene) => {
    const noise = new Noise(31);
    return everywhere(
      scene,
      Array.from({ length: 100 }, () => noise.bytes(noise.below(300))),
    );
  },
  'texts that crash services': (scene) => everywhere(scene, [...hostileTexts, ...hugeTexts]),
  'message of 8 MB': (scene) => everywhere(scene, [new Uint8Array(8 << 20)]),
  'commands for robots that do not exist': (scene) =>
    everywhere(
      scene,
      ['selectRobot', 'switchRobot', 'initBridge', 'getRobots', '__proto__'].flatMap((type) =>
        [-1, 1e9, null, '__proto__', {}].map((robotId) => JSON.stringify({ type, robotId, id: robotId })),
      ),
    ),
  'pages that come and go': async (scene) => {
    for (let n = 0; n < 50; n++) {
      const socket = await RawSocket.open(`ws://127.0.0.1:${scene.bridge.ports.streaming}/`);
      socket.close();
    }
  },
  'robot whose offer is none': async (scene) => {
    const url = `ws://127.0.0.1:${scene.stack.ports.referenceRobot}/`;
    for (const sdpOffer of ['', 'v=0', 'x'.repeat(50_000), `v=0\r\n${'m=audio 9 x 0\r\n'.repeat(1000)}`]) {
      const robot = await RawSocket.open(url);
      scene.later(() => robot.close());
      robot.send({ type: 'register', name: 'Eve', sdpOffer });
      await robot.handled();
    }
    await pause(300);
  },
  'robot that sends rubbish for points': async (scene) => {
    const robot = await ReferenceRobot.register(
      `ws://127.0.0.1:${scene.stack.ports.referenceRobot}`,
      'Mallory',
    );
    scene.later(() => robot.close());
    await robot.ready();
    const noise = new Noise(32);
    for (let n = 0; n < 200; n++) robot.sendFrame([noise.bytes(noise.below(1300)), new Uint8Array(0)]);
    await pause(300);
  },
});
