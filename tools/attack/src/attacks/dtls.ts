import { clientHello, closeAlert, dtlsRecord, fatalAlert, handshakeRecord } from '@farpoint/webrtc/testing';
import { createSelfSignedCertificate } from 'werift';
import { attacks } from '../attack.ts';
import { inTime, mustHold } from '../harm.ts';
import { Noise } from '../noise.ts';
import { ROBOT, type Scene } from '../scene.ts';

const DTLS_APPLICATION_DATA = 23;
const signatureHash = { hash: 4, signature: 3 } as const;

const zeros = (length: number): number[] => new Array<number>(length).fill(0);
/** A handshake header with any lengths. */
const fragment = (type: number, length: number, offset: number, own: number, data: readonly number[]) =>
  dtlsRecord(
    22,
    0,
    9,
    Uint8Array.of(type, ...bytes3(length), 0, 0, ...bytes3(offset), ...bytes3(own), ...data),
  );
const bytes3 = (value: number) => [(value >> 16) & 255, (value >> 8) & 255, value & 255];

/** A session that must be refused. */
async function expectRefused(scene: Scene, keys: { certPem: string; keyPem: string }): Promise<void> {
  const impostor = await scene.asker(ROBOT, { keys: { ...keys, signatureHash } });
  await inTime(
    impostor.until(({ type }) => type === 'session.closed'),
    'the impostor’s session was not ended',
  );
  mustHold(impostor.client.session.length === 0, 'the impostor was welcomed');
  mustHold(impostor.client.packets === 0, 'the impostor got media');
}

async function certificates() {
  return Promise.all([0, 0].map(() => createSelfSignedCertificate(signatureHash)));
}

/** On records and handshakes, from a stranger's address and from the driver's own, which a stranger can forge. */
export const dtlsAttacks = attacks('dtls', {
  'plaintext close alert from a stranger': (scene) => scene.fromStranger(closeAlert),
  'plaintext close alert with the driver’s address': (scene) => scene.asDriver(closeAlert),
  'plaintext fatal alert from both': (scene) => scene.fromBoth(fatalAlert),
  'new ClientHello from a stranger': (scene) => scene.unanswered(() => scene.fromStranger(clientHello())),
  'new ClientHello with the driver’s address': (scene) => scene.asDriver(clientHello()),
  'hundred ClientHellos with other randoms': async (scene) => {
    for (let n = 0; n < 100; n++) await scene.fromBoth(clientHello(n, n));
  },
  'whole client flight in plaintext': (scene) =>
    scene.fromBoth(...[11, 16, 15, 20].map((type, n) => handshakeRecord(type, zeros(64), n))),
  'server’s messages to the server': (scene) =>
    scene.fromBoth(...[0, 2, 3, 12, 13, 14].map((type, n) => handshakeRecord(type, zeros(40), n))),
  'ChangeCipherSpec again': (scene) => scene.fromBoth(dtlsRecord(20, 0, 1, Uint8Array.of(1))),
  'forged alert in the encrypted epoch': (scene) =>
    scene.fromBoth(dtlsRecord(21, 1, 900, Uint8Array.of(1, 0)), dtlsRecord(21, 1, 901, new Uint8Array(40))),
  'forged data in the encrypted epoch, a thousand records': async (scene) => {
    const noise = new Noise(1);
    for (let n = 0; n < 1000; n++) await scene.asDriver(dtlsRecord(23, 1, 10_000 + n, noise.bytes(80)));
  },
  'forged record with the highest sequence number': (scene) =>
    scene.fromBoth(dtlsRecord(23, 1, 2 ** 48 - 1, new Uint8Array(60))),
  'records of epochs 2 and 65,535': (scene) =>
    scene.fromBoth(dtlsRecord(23, 2, 0, new Uint8Array(40)), dtlsRecord(22, 65_535, 0, new Uint8Array(40))),
  'forged handshake in the encrypted epoch': (scene) =>
    scene.fromBoth(dtlsRecord(22, 1, 5, new Uint8Array(60))),
  'lengths beyond the datagram': (scene) => {
    const record = dtlsRecord(23, 1, 1, new Uint8Array(40));
    record.writeUInt16BE(4000, 11);
    return scene.fromBoth(record, record.subarray(0, 14));
  },
  'records of length 0': (scene) =>
    scene.fromBoth(Buffer.concat(Array(50).fill(dtlsRecord(22, 0, 0, new Uint8Array(0))))),
  'fragment of a message of 16 MB': (scene) => scene.fromBoth(fragment(11, 0xffffff, 0, 4, [1, 2, 3, 4])),
  'fragments that contradict each other': (scene) =>
    scene.fromBoth(
      fragment(11, 100, 0, 4, [1, 2, 3, 4]),
      fragment(11, 50, 90, 8, zeros(8)),
      fragment(1, 100, 4, 0xffffff, [1]),
    ),
  'other versions and content types': (scene) => {
    const all = [0xfeff, 0xfefc, 0x0303, 0x0100].flatMap((version) =>
      [19, 20, 21, 22, 23, 24, 25, 26].map((type) => {
        const record = dtlsRecord(type, 1, 77, new Uint8Array(30));
        record.writeUInt16BE(version, 1);
        return record;
      }),
    );
    return scene.fromBoth(...all);
  },
  'random bytes in the range of DTLS': async (scene) => {
    const noise = new Noise(2);
    for (let n = 0; n < 500; n++) {
      const datagram = noise.bytes(1 + noise.below(1400));
      datagram[0] = 20 + noise.below(44);
      await scene.fromBoth(datagram);
    }
  },
  'the driver’s own records again': async (scene) => {
    const records = (await scene.driver.record(400)).filter(([type]) => type === DTLS_APPLICATION_DATA);
    mustHold(records.length > 0, 'nothing was recorded');
    await scene.fromBoth(...records, ...records);
  },
  'the driver’s own records with one bit changed': async (scene) => {
    const records = (await scene.driver.record(400)).filter(([type]) => type === DTLS_APPLICATION_DATA);
    for (const record of records) {
      record.writeUInt8(record.readUInt8(record.length - 1) ^ 1, record.length - 1);
      await scene.fromBoth(record);
    }
  },
  'operator without the key of its certificate': async (scene) => {
    const [own, other] = await certificates();
    await expectRefused(scene, { certPem: own?.certPem ?? '', keyPem: other?.keyPem ?? '' });
  },
  'operator with another certificate than its answer names': async (scene) => {
    const impostor = await scene.asker(ROBOT);
    const answer = impostor.client.answer.bind(impostor.client);
    impostor.client.answer = async (offer) =>
      (await answer(offer)).replaceAll(/(?<=fingerprint:sha-256 )../gi, (byte) =>
        byte === 'FF' ? '00' : 'FF',
      );
    await inTime(
      impostor.until(({ type }) => type === 'session.closed'),
      'the impostor’s session was not ended',
    );
    mustHold(impostor.client.packets === 0, 'the impostor got media');
  },
});
