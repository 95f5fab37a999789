import type { SignaledOperator } from '@farpoint/robot-node/testing';
import { attacks } from '../attack.ts';
import { inTime, mustHold, pause } from '../harm.ts';
import { Noise } from '../noise.ts';
import type { Scene } from '../scene.ts';

type Client = SignaledOperator['client'];

/** From a second operator of the driven robot. */
function withGuest(act: (client: Client, scene: Scene, guest: SignaledOperator) => unknown) {
  return async (scene: Scene): Promise<void> => {
    const guest = await scene.guest();
    await act(guest.client, scene, guest);
    await pause(200);
  };
}

/** The driver’s command with some of it replaced. */
const command = (change: object) =>
  JSON.stringify({
    type: 'command',
    sequence: 1,
    timeMs: performance.now(),
    lease: 'x'.repeat(22),
    deadMan: true,
    twist: { linear: { x: -1, y: 0, z: 0 }, angular: { x: 0, y: 0, z: -1 } },
    ...change,
  });

async function expectRejected(client: Client): Promise<void> {
  await inTime(client.message('rejected'), 'a command without the lease was not rejected');
}

/** Messages that the robot reads, from an operator that may watch and wants more. */
export const sessionAttacks = attacks('session', {
  'command with an invented lease': withGuest(async (client) => {
    client.control.send(command({}));
    await expectRejected(client);
  }),
  'command with the driver’s lease': withGuest(async (client, { driver }) => {
    client.control.send(command({ lease: driver.lease, sequence: 2 ** 31 }));
    await expectRejected(client);
  }),
  'commands with numbers that are none': withGuest((client, { driver }) => {
    const { lease } = driver;
    for (const x of [null, 'NaN', 1e308, -1e308, [], {}, true]) {
      client.control.send(
        command({ lease, twist: { linear: { x, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } } }),
      );
    }
    for (const raw of ['NaN', 'Infinity', '1e999', '-0']) {
      client.control.send(command({ lease }).replace('-1', raw));
    }
  }),
  'commands from the past and the future': withGuest((client, { driver }) => {
    for (const timeMs of [0, -1, 1e15, Number.MAX_SAFE_INTEGER, -1e300]) {
      client.control.send(command({ lease: driver.lease, timeMs }));
    }
  }),
  'takes the lease while somebody drives': withGuest(async (client) => {
    client.sendSession({ type: 'leaseRequest', take: true });
    await inTime(client.message('fault'), 'the lease was not refused');
  }),
  'releases the lease of somebody else': withGuest((client) => client.sendSession({ type: 'leaseRelease' })),
  'releases an emergency stop that is not latched': withGuest((client) =>
    client.sendSession({ type: 'estop', latch: false }),
  ),
  'thousand lease requests': withGuest(async (client) => {
    for (let n = 0; n < 1000; n++) client.sendSession({ type: 'leaseRequest', take: true });
    await pause(500);
  }),
  'a thousand clock probes in a second': withGuest(async (client, scene) => {
    for (let id = 0; id < 1000; id++) {
      client.sendControl({ type: 'clockProbe', id, sentMs: 0 });
      // The kit's own stack would be busier with more at once than the robot.
      if (id % 50 === 49) await pause(50);
    }
    const limited = await scene.metric(
      'farpoint_robot_refused_total',
      '{what="message",reason="probe:rate-limited"}',
    );
    mustHold(limited > 0, 'every probe was answered');
  }),
  'two thousand commands at once': withGuest(async (client) => {
    for (let sequence = 0; sequence < 2000; sequence++) client.control.send(command({ sequence }));
    await pause(500);
  }),
  'receiver reports that lie': withGuest((client) => {
    for (let sequence = 0; sequence < 100; sequence++) {
      const lie = sequence % 2 === 0 ? 1e308 : -1;
      client.control.send(
        JSON.stringify({
          type: 'receiverReport',
          sequence,
          delayMs: lie,
          receivedPackets: lie,
          lostPackets: lie,
        }),
      );
    }
  }),
  'text that is no message': withGuest((client) => {
    for (const text of ['', '{', 'null', '[]', '{"type":"__proto__"}', '\u0000', 'start'.repeat(100)]) {
      client.control.send(text);
      client.sendSession(text as never);
    }
  }),
  'nested sixty thousand deep': withGuest((client) => client.control.send('['.repeat(60_000))),
  'message of 64 KiB on every channel': withGuest((client) => {
    client.control.send(`{"type":"command","lease":"${'x'.repeat(65_000)}"}`);
    client.sendBandwidth(new Uint8Array(65_000));
  }),
  'random bytes on every channel': withGuest((client) => {
    const noise = new Noise(7);
    for (let n = 0; n < 200; n++) {
      client.control.send(noise.bytes(noise.below(300)));
      client.sendBandwidth(noise.bytes(noise.below(20)));
    }
  }),
  'damaged messages of the protocol': withGuest((client) => {
    const noise = new Noise(8);
    for (let n = 0; n < 400; n++) {
      const text = Buffer.from(command({ sequence: n }));
      for (let changes = 1 + noise.below(3); changes > 0; changes--)
        text[noise.below(text.length)] = noise.below(128);
      client.control.send(text.toString('latin1'));
    }
  }),
  'wants what is not there': withGuest((client) => {
    client.sendSession({ type: 'pictures', cameras: [0, 1, 2, 3, 4, 5, 6, 7] });
    client.sendSession({ type: 'sensors', sensors: [7] });
    client.sendSession({ type: 'videos', videos: [0, 1, 2, 3], barcode: true });
    client.sendSession({ type: 'listen', on: true });
    client.sendSession({ type: 'speak', held: true });
  }),
  'switches its stream two hundred times': withGuest((client) => {
    for (let n = 0; n < 200; n++) client.sendSession({ type: 'stream', running: n % 2 === 0 });
  }),
  'limits the stream to nothing, and to everything': withGuest((client) => {
    client.sendBandwidth(new Uint8Array(4));
    client.sendBandwidth(new Uint8Array(4).fill(255));
    client.sendBandwidth(new Uint8Array(8).fill(127));
  }),
  'resumes its own session with a wrong key': withGuest(async (_client, _scene, guest) => {
    await guest.resume('w'.repeat(22));
    await pause(300);
  }),
  'disappears in the middle of everything': withGuest((_client, _scene, guest) => guest.vanish()),
  'two operators join and leave ten times': async (scene) => {
    for (let n = 0; n < 5; n++) {
      const both = await Promise.all([scene.guest(), scene.guest()]);
      await Promise.all(both.map((guest) => guest.close()));
    }
    mustHold(scene.driver.operator.session === scene.driver.session, 'the driver has another session');
  },
});
