import { sendRtcp } from '@farpoint/webrtc';
import { noiseRtcp, noiseRtp } from '@farpoint/webrtc/testing';
import { attacks } from '../attack.ts';
import { mustHold, pause } from '../harm.ts';
import { Noise } from '../noise.ts';
import type { Scene } from '../scene.ts';

const isRtcp = (datagram: Buffer) => {
  const [first = 0, type = 0] = datagram;
  return first >> 6 === 2 && type >= 192 && type <= 223;
};

/** Sends compound RTCP packets that are authentic: under the keys of an operator that has a session. */
async function fromGuest(scene: Scene, ...compounds: readonly Buffer[]): Promise<void> {
  const guest = await scene.guest();
  const [transport] = guest.client.connection.dtlsTransports;
  for (const compound of compounds) if (transport !== undefined) sendRtcp(transport, compound);
  await pause(200);
}

/** A feedback packet (RFC 4585 §6.1) about SSRC 1 with these bytes for its information. */
function feedback(type: number, format: number, information: readonly number[], words?: number): Buffer {
  const packet = Buffer.alloc(12 + information.length);
  packet.writeUInt8(0x80 | format, 0);
  packet.writeUInt8(type, 1);
  packet.writeUInt16BE(words ?? packet.length / 4 - 1, 2);
  packet.writeUInt32BE(1, 4);
  packet.writeUInt32BE(1, 8);
  packet.set(information, 12);
  return packet;
}

const repeated = (count: number, ...bytes: readonly number[]) =>
  new Array<readonly number[]>(count).fill(bytes).flat();

/** On media and its control packets, unauthenticated and from an operator that has keys. */
export const srtpAttacks = attacks('srtp', {
  'forged RTP of every payload type': async (scene) => {
    for (let type = 0; type < 128; type++) await scene.fromBoth(noiseRtp(type, type, type));
  },
  'forged RTP with 15 sources and no room for them': (scene) => {
    const packet = noiseRtp(96, 1, 1, 20);
    packet[0] = 0x8f;
    return scene.fromBoth(packet);
  },
  'forged RTP with an extension beyond the packet': (scene) => {
    const packet = noiseRtp(96, 1, 1, 24);
    packet[0] = 0x90;
    packet.writeUInt16BE(0xffff, 14);
    return scene.fromBoth(packet);
  },
  'forged RTP with padding longer than itself': (scene) => {
    const packet = noiseRtp(96, 1, 1, 40);
    packet[0] = 0xa0;
    packet[39] = 255;
    return scene.fromBoth(packet);
  },
  'RTP headers cut off at every length': (scene) =>
    scene.fromBoth(...Array.from({ length: 30 }, (_, length) => noiseRtp(111, 1, 1).subarray(0, length))),
  'forged RTCP of every type': async (scene) => {
    for (let type = 192; type < 224; type++) await scene.fromBoth(noiseRtcp(type), noiseRtcp(type, 1, 12));
  },
  'RTCP cut off at every length': (scene) =>
    scene.fromBoth(...Array.from({ length: 40 }, (_, length) => noiseRtcp(205).subarray(0, length))),
  'the driver’s own RTCP again': async (scene) => {
    const packets = (await scene.driver.record(1500)).filter(isRtcp);
    await scene.fromBoth(...packets, ...packets);
  },
  'five hundred random media packets': async (scene) => {
    const noise = new Noise(4);
    for (let n = 0; n < 500; n++) {
      const packet = noise.bytes(2 + noise.below(1200));
      packet[0] = 128 + noise.below(64);
      await scene.fromBoth(packet);
    }
  },
  'authentic: transport feedback about packets never sent': (scene) =>
    fromGuest(scene, feedback(205, 15, [0xff, 0, 0x7f, 0xff, 0, 0, 0, 1, ...repeated(8, 0x7f, 0xff)])),
  'authentic: transport feedback whose chunks lie': (scene) =>
    fromGuest(
      scene,
      ...[0x00, 0x1f, 0x20, 0x3f, 0x40, 0x7f, 0x80, 0xbf, 0xc0, 0xff].map((chunk) =>
        feedback(205, 15, [0, 1, 0xff, 0xff, 0x80, 0, 0, chunk, ...repeated(6, chunk, 0xff)]),
      ),
    ),
  'authentic: ten thousand lost packets requested': (scene) =>
    fromGuest(
      scene,
      ...Array.from({ length: 20 }, (_, n) => feedback(205, 1, repeated(500, n, 0, 0xff, 0xff))),
    ),
  'authentic: thousand requests for key frames': (scene) =>
    fromGuest(scene, ...new Array<Buffer>(1000).fill(feedback(206, 1, []))),
  'authentic: rates of 0 and of infinity': (scene) => {
    const remb = (...rate: readonly number[]) =>
      feedback(206, 15, [0x52, 0x45, 0x4d, 0x42, 1, ...rate, 0, 0, 0, 1]);
    return fromGuest(scene, remb(0, 0, 0), remb(0xff, 0xff, 0xff));
  },
  'authentic: lengths beyond the packet': (scene) =>
    fromGuest(
      scene,
      feedback(205, 15, repeated(4, 1, 2), 9999),
      feedback(206, 1, [], 0),
      feedback(200, 31, []),
    ),
  'authentic: random compounds': async (scene) => {
    const noise = new Noise(5);
    const compounds = Array.from({ length: 500 }, () => {
      const packet = feedback(200 + noise.below(8), noise.below(32), [...noise.bytes(4 * noise.below(60))]);
      return noise.below(2) === 0 ? packet : Buffer.concat([packet, noise.bytes(noise.below(30))]);
    });
    await fromGuest(scene, ...compounds);
  },
  'authentic: goodbye for the driver’s streams': async (scene) => {
    const before = scene.driver.operator.client.packets;
    await fromGuest(scene, feedback(203, 2, []));
    mustHold(scene.driver.operator.client.packets > before, 'the driver gets no more packets');
  },
});
