import fc from 'fast-check';
import { describe, expect, it, test } from 'vitest';
import { annexBNalUnits, isH264KeyFrame } from './h264-nal.ts';
import { packetiseH264 } from './h264-payload.ts';
import { annexB, PPS, SPS, slice, vp8Frame } from './testing/pictures.ts';
import {
  VideoDepacketiser,
  type VideoDepacketiserOptions,
  type WholeVideoFrame,
} from './video-depacketiser.ts';
import { packetiseVp8 } from './vp8-payload.ts';

type Codec = 'h264' | 'vp8';
interface Packet {
  sequence: number;
  timestamp: number;
  marker: boolean;
  payload: Uint8Array;
}

const hex = (text: string) => new Uint8Array(Buffer.from(text.replaceAll(' ', ''), 'hex'));
const SIZE = { width: 320, height: 240 };
const MAX = 40;

/** Key frame, two frames that build on it, key frame, one more; each of three payloads or more. */
const PICTURES: Record<Codec, Uint8Array[]> = {
  h264: [
    annexB([SPS, PPS, slice(true, 100)]),
    annexB([slice(false, 90)]),
    annexB([slice(false, 110, 0x11)]),
    annexB([SPS, PPS, slice(true, 101, 0x22)]),
    annexB([slice(false, 91, 0x33)]),
  ],
  vp8: [
    vp8Frame(SIZE, 100),
    vp8Frame(null, 90),
    vp8Frame(null, 110),
    vp8Frame(SIZE, 101),
    vp8Frame(null, 91),
  ],
};
const KEYS = [0, 3];

/** Across the wrap of the sequence number. */
function packetsOf(codec: Codec): (Packet & { picture: number })[] {
  const packets = PICTURES[codec].flatMap((bytes, picture) => {
    const payloads =
      codec === 'h264' ? packetiseH264(bytes, MAX) : packetiseVp8(bytes, 0x7fff + picture, MAX);
    return payloads.map((payload, i) => ({
      ...{ picture, payload, timestamp: (0xffff_f000 + picture * 3000) >>> 0 },
      marker: i === payloads.length - 1,
    }));
  });
  return packets.map((packet, i) => ({ ...packet, sequence: (0xfffa + i) & 0xffff }));
}

function takeAll(depacketiser: VideoDepacketiser, packets: readonly Packet[]): WholeVideoFrame[] {
  const frames = packets.map((p) => depacketiser.take(p.sequence, p.timestamp, p.marker, p.payload));
  return frames.filter((frame) => frame !== null);
}

/** The result of these payloads as one frame of H.264, with the marker on the last one. */
function h264(payloads: readonly string[], options: VideoDepacketiserOptions = {}) {
  const depacketiser = new VideoDepacketiser('h264', options);
  const packets = payloads.map((text, i) => ({
    ...{ sequence: i, timestamp: 1, marker: i === payloads.length - 1, payload: hex(text) },
  }));
  const [frame] = takeAll(depacketiser, packets);
  return {
    bytes: frame === undefined ? null : Buffer.from(frame.bytes).toString('hex'),
    drops: reasons(depacketiser),
  };
}

const reasons = ({ drops }: VideoDepacketiser) =>
  Object.fromEntries(Object.entries(drops).filter(([, count]) => count > 0));

describe.each(['h264', 'vp8'] as const)('%s', (codec) => {
  const packets = packetsOf(codec);
  const pictures = PICTURES[codec];

  it('gives every frame of a stream without losses', () => {
    for (const waitForKeyFrame of [false, true]) {
      const depacketiser = new VideoDepacketiser(codec, { waitForKeyFrame });
      expect(takeAll(depacketiser, packets)).toEqual(
        pictures.map((bytes, i) => ({
          ...{ bytes, isKeyFrame: KEYS.includes(i), timestamp: (0xffff_f000 + i * 3000) >>> 0 },
        })),
      );
      expect(reasons(depacketiser)).toEqual({});
      expect(depacketiser.needsKeyFrame).toBe(false);
    }
  });

  test.each(packets.map((packet, i) => [i, packet.picture] as const))(
    'a lost packet %i costs frame %i, and the frames that build on it if asked to',
    (lost, picture) => {
      const rest = packets.filter((_, i) => i !== lost);
      const indices = (frames: WholeVideoFrame[]) =>
        frames.map(({ bytes }) => pictures.findIndex((each) => Buffer.from(each).equals(bytes)));

      const plain = new VideoDepacketiser(codec);
      const others = [...pictures.keys()].filter((i) => i !== picture);
      expect(indices(takeAll(plain, rest))).toEqual(others);
      const isUnseen = lost === packets.length - 1;
      expect(reasons(plain)).toEqual(isUnseen ? {} : { 'lost-packet': 1 });

      const waiting = new VideoDepacketiser(codec, { waitForKeyFrame: true });
      const nextKey = KEYS.find((key) => key > picture) ?? pictures.length;
      const usable = [...pictures.keys()].filter((i) => i < picture || i >= nextKey);
      expect(indices(takeAll(waiting, rest))).toEqual(usable);
      expect(waiting.needsKeyFrame).toBe(nextKey === pictures.length && !isUnseen);
    },
  );

  it('begins with the first whole frame when it joins in the middle', () => {
    const depacketiser = new VideoDepacketiser(codec);
    expect(takeAll(depacketiser, packets.slice(1)).map(({ bytes }) => bytes)).toEqual(pictures.slice(1));
    expect(reasons(depacketiser)).toEqual({ 'lost-packet': 1 });
    const waiting = new VideoDepacketiser(codec, { waitForKeyFrame: true });
    expect(waiting.needsKeyFrame).toBe(true);
    expect(takeAll(waiting, packets.slice(1)).map(({ bytes }) => bytes)).toEqual(pictures.slice(3));
    expect(reasons(waiting)).toEqual({ 'lost-packet': 1, 'awaiting-key-frame': 2 });
  });

  it('passes over packets that come twice, and padding', () => {
    const depacketiser = new VideoDepacketiser(codec);
    const twice = packets.flatMap((packet) => [packet, packet]);
    expect(takeAll(depacketiser, twice)).toHaveLength(5);
    expect(reasons(depacketiser)).toEqual({ late: packets.length });
    const padded = packets.flatMap((packet, i) => [
      { ...packet, sequence: 2 * i },
      { ...packet, sequence: 2 * i + 1, marker: false, payload: new Uint8Array(0) },
    ]);
    expect(takeAll(new VideoDepacketiser(codec), padded)).toHaveLength(5);
  });

  it('goes on after a jump of the sequence number in either direction', () => {
    for (const jump of [200, -200, 32_768]) {
      const depacketiser = new VideoDepacketiser(codec);
      takeAll(depacketiser, packets);
      const later = packets.map((packet) => ({ ...packet, sequence: (packet.sequence + jump) & 0xffff }));
      expect(takeAll(depacketiser, later)).toHaveLength(5);
    }
  });

  it('drops a frame without a marker when the next one begins', () => {
    const depacketiser = new VideoDepacketiser(codec);
    const without = packets.map((packet) => ({ ...packet, marker: packet.marker && packet.picture !== 1 }));
    expect(takeAll(depacketiser, without)).toHaveLength(4);
    expect(reasons(depacketiser)).toEqual({ 'no-marker': 1 });
  });

  it('drops a frame over the limit, and keeps one that reaches it', () => {
    const longest = Math.max(...pictures.map(({ length }) => length));
    const count = (maxFrameBytes: number) => {
      const depacketiser = new VideoDepacketiser(codec, { maxFrameBytes });
      return { frames: takeAll(depacketiser, packets).length, drops: reasons(depacketiser) };
    };
    expect(count(longest)).toEqual({ frames: 5, drops: {} });
    expect(count(longest - 1)).toEqual({ frames: 4, drops: { 'too-large': 1 } });
    expect(count(1)).toEqual({ frames: 0, drops: { 'too-large': 5 } });
  });

  it('any packets give valid frames within the limit, or a reason', () => {
    const outcomes = new Set<string>();
    const change = fc.record({
      drop: fc.constantFrom(false, false, false, true),
      at: fc.oneof(fc.constant(-1), fc.nat(8), fc.nat(MAX)),
      value: fc.nat(255),
      cut: fc.oneof(fc.constant(MAX), fc.constant(MAX), fc.nat(MAX)),
      jump: fc.oneof(fc.constant(0), fc.constant(0), fc.nat(0xffff)),
      later: fc.constantFrom(0, 0, 0, 0, 3000),
      marker: fc.constantFrom(false, false, false, false, true),
    });
    const changes = fc.array(change, { minLength: packets.length, maxLength: packets.length });
    fc.assert(
      fc.property(changes, fc.boolean(), fc.constantFrom(60, 4096), (all, waitForKeyFrame, maxFrameBytes) => {
        const depacketiser = new VideoDepacketiser(codec, { waitForKeyFrame, maxFrameBytes });
        for (const [i, { drop, at, value, cut, jump, later, marker }] of all.entries()) {
          if (drop) continue;
          const packet = packets[i] as Packet;
          const payload = packet.payload.slice(0, cut);
          if (at >= 0 && at < payload.length) payload[at] = value;
          const sequence = (packet.sequence + jump) & 0xffff;
          const isLast = packet.marker !== marker;
          const frame = depacketiser.take(sequence, packet.timestamp + later, isLast, payload);
          if (frame === null) continue;
          outcomes.add('frame');
          expect(frame.bytes.length).toBeLessThanOrEqual(maxFrameBytes);
          if (codec === 'h264') expect([...annexBNalUnits(frame.bytes)].length).toBeGreaterThan(0);
          if (codec === 'h264' && frame.isKeyFrame) expect(isH264KeyFrame(frame.bytes)).toBe(true);
        }
        for (const reason of Object.keys(reasons(depacketiser))) outcomes.add(reason);
      }),
      { seed: 5, numRuns: 1500 },
    );
    expect([...outcomes].sort()).toEqual([
      ...['awaiting-key-frame', 'frame', 'late', 'lost-packet', 'malformed', 'no-marker', 'too-large'],
    ]);
  });

  it('any bytes give frames or a reason', () => {
    const head = fc.constantFrom(...(codec === 'h264' ? [0x78, 0x7c, 0x65, 0x41] : [0x90, 0x80, 0x10, 0]));
    const payload = fc
      .tuple(head, fc.uint8Array({ maxLength: 60, size: 'max' }))
      .map(([first, bytes]) => Uint8Array.of(first, ...bytes));
    fc.assert(
      fc.property(fc.array(fc.tuple(payload, fc.boolean()), { maxLength: 12 }), (some) => {
        const depacketiser = new VideoDepacketiser(codec, { maxFrameBytes: 200 });
        for (const [i, [bytes, marker]] of some.entries()) {
          const frame = depacketiser.take(i, 0, marker, bytes);
          expect(frame?.bytes.length ?? 1).toSatisfy((length: number) => length >= 1 && length <= 200);
        }
      }),
      { seed: 6, numRuns: 2000 },
    );
  });
});

describe('H.264 payloads', () => {
  it('reads single NAL units, STAP-A and FU-A', () => {
    expect(h264(['780004' + '6742c01f' + '000428ce3c80', '65888421a0']).bytes).toBe(
      '00000001' + '6742c01f' + '00000001' + '28ce3c80' + '00000001' + '65888421a0',
    );
    expect(h264(['0910', '7c858884', '7c0521a0', '7c45b1']).bytes).toBe(
      '000000010910' + '0000000165888421a0b1',
    );
  });

  it.each<[string, string[]]>([
    ['type 0', ['6788', '6088']],
    ['STAP-B, MTAP and FU-B', ['6788', '7988']],
    ['type 31', ['6788', '7f88']],
    ['the forbidden bit', ['6788', 'c188']],
    ['an empty STAP-A', ['6788', '78']],
    ['a STAP-A with an empty NAL unit', ['6788', '780000']],
    ['a STAP-A whose last NAL unit is cut off', ['6788', '78000209100004' + '6742c0']],
    ['a STAP-A that ends inside a length', ['6788', '780002091000']],
    ['a STAP-A inside a STAP-A', ['6788', '7800027800']],
    ['a fragment without content', ['6788', '7c85']],
    ['start and end in one fragment', ['6788', '7cc588']],
    ['a fragment of a fragment', ['6788', '7c9c88', '7c5c88']],
    ['a fragment without start', ['6788', '7c4588']],
    ['a fragment of another NAL unit', ['5c8188', '5c4588']],
    ['two starts', ['5c8188', '5c8188', '5c4188']],
    ['another NAL unit between fragments', ['5c8188', '4188', '5c4188']],
    ['no end', ['5c8188', '5c0188']],
    ['a start code inside a NAL unit', ['41880000016588']],
  ])('refuses %s', (_name, payloads) => {
    expect(h264(payloads)).toEqual({ bytes: null, drops: { malformed: 1 } });
  });

  it('takes no IDR picture for a key frame before there were parameter sets', () => {
    expect(h264(['0910', '6588'], { waitForKeyFrame: true }).drops).toEqual({ 'awaiting-key-frame': 1 });
    expect(h264(['6788', '6888', '6588'], { waitForKeyFrame: true }).drops).toEqual({});
  });

  it('no later slice begins a frame after a loss, and no IDR picture without its parameter sets', () => {
    expect(h264(['4128']).drops).toEqual({ 'lost-packet': 1 });
    expect(h264(['780002412800024188']).drops).toEqual({ 'lost-packet': 1 });
    expect(h264(['7c812899', '7c4199']).drops).toEqual({ 'lost-packet': 1 });
    expect(h264(['7c818899', '7c4199', '4128']).drops).toEqual({});
    expect(h264(['7c858899', '7c4599']).drops).toEqual({ 'lost-packet': 1 });
  });
});

describe('VP8 payloads', () => {
  const drops = (payloads: readonly string[]) => {
    const depacketiser = new VideoDepacketiser('vp8');
    for (const [i, text] of payloads.entries()) depacketiser.take(i, 1, i === payloads.length - 1, hex(text));
    return reasons(depacketiser);
  };

  it('reads a frame with and without picture ids', () => {
    expect(drops(['90800731', '8080070000aa'])).toEqual({});
    expect(drops(['1031', '000000aa'])).toEqual({});
    expect(drops(['1031', '110000aa'])).toEqual({});
  });

  it.each<[string, string[]]>([
    ['a payload that is only a descriptor', ['1031', '9080']],
    ['two beginnings', ['1031', '100000aa']],
    ['another picture id', ['90800731', '8080080000aa']],
    ['a picture id that is missing', ['90800731', '000000aa']],
    ['a frame shorter than its header', ['1031', '0000']],
    ['a frame shorter than its first partition', ['1051', '000000aa']],
    ['a key frame without start code', ['1030', '0000000102030405060708']],
  ])('refuses %s', (_name, payloads) => {
    expect(drops(payloads)).toEqual({ malformed: 1 });
  });
});

it.each([0, -1, 1.5, Number.NaN])('refuses a limit of %d bytes', (maxFrameBytes) => {
  expect(() => new VideoDepacketiser('h264', { maxFrameBytes })).toThrow(RangeError);
});
