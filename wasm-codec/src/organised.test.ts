import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { CodecError } from './errors.ts';
import { loadCodecFromDisk } from './load-node.ts';
import { OrganisedDecoder, TILE_SAMPLES } from './organised-decoder.ts';
import { OrganisedEncoder, type Pinhole } from './organised-encoder.ts';

const codec = await loadCodecFromDisk();
const size = { width: 120, height: 90 };
const camera: Pinhole = { fx: 100, fy: 101, cx: 59.5, cy: 44 };

/** A sloping plane with a hole and a checked pattern. */
function fill(frame: Float32Array, bits: Uint32Array, depthAt: (u: number, v: number) => number): void {
  for (let v = 0; v < size.height; v++) {
    for (let u = 0; u < size.width; u++) {
      const i = (v * size.width + u) * 4;
      const z = depthAt(u, v);
      frame[i] = ((u - camera.cx) * z) / camera.fx;
      frame[i + 1] = ((v - camera.cy) * z) / camera.fy;
      frame[i + 2] = z;
      bits[i + 3] = ((u >> 3) + (v >> 3)) % 2 === 0 ? 0xff20_4060 : 0xff60_a0c0;
    }
  }
}

const plane = (u: number, v: number): number => (u > 20 && u < 40 && v > 30 ? Number.NaN : 6 - v * 0.04);

/** Whether one of a pixel's neighbours was seen. */
function isBesideSeen(depth: Float32Array, u: number, v: number): boolean {
  return [-1, 0, 1].some((dv) => [-1, 0, 1].some((du) => (depth[(v + dv) * size.width + u + du] ?? 0) > 0));
}

function encoded(options: Parameters<OrganisedEncoder['encode']>[0], palette = false) {
  const encoder = new OrganisedEncoder(codec, size);
  fill(encoder.frame, encoder.frameBits, plane);
  const header = encoder.begin(camera, { palette });
  const report = encoder.encode(options);
  const packets = Array.from({ length: report.packets }, (_, i) => encoder.packet(i).slice());
  return { encoder, header, report, packets };
}

describe('OrganisedEncoder and OrganisedDecoder', () => {
  test('return every valid point, whatever the order of the packets', () => {
    const { header, report, packets } = encoded({ depthLevel: 2, colour: { quality: 6, chroma: 'full' } });
    expect(report.points).toBe(size.width * size.height - 19 * 59);
    expect(report.reasons.notFinite).toBe(19 * 59);
    expect(report.bytes).toBe(packets.reduce((sum, packet) => sum + packet.length, 0));
    const decoder = new OrganisedDecoder(codec, header, { images: true });
    for (const packet of packets.toReversed()) expect(decoder.put(packet)).toHaveProperty('points');
    expect(decoder.count).toBe(report.points);
    decoder.depth.forEach((z, i) => {
      const exact = plane(i % size.width, Math.floor(i / size.width));
      if (Number.isNaN(exact)) expect(z).toBe(0);
      else expect(Math.abs(z - exact)).toBeLessThanOrEqual(0.000_25 * exact * exact);
    });
    const points = new Int16Array(decoder.unpack().slice().buffer);
    expect(points).toHaveLength(report.points * 4);
    decoder.begin();
    expect(decoder.count).toBe(0);
    expect(decoder.depth.every((z) => z === 0)).toBe(true);
  });

  test('decode a frame as a surface: the same depths and colours, tile by tile', () => {
    const { header, packets, report } = encoded({ depthLevel: 2, colour: { quality: 0, chroma: 'full' } });
    const images = new OrganisedDecoder(codec, header, { images: true });
    const [surface, inPairs] = [new OrganisedDecoder(codec, header), new OrganisedDecoder(codec, header)];
    for (const decoder of [surface, inPairs]) {
      decoder.surface = true;
      expect(decoder.isSurface).toBe(false);
      decoder.begin();
      expect(decoder.isSurface).toBe(true);
    }
    for (const packet of packets) images.put(packet);
    const results = packets.map((packet) => surface.put(packet));
    for (let i = 0; i + 1 < packets.length; i += 2) {
      const pair = inPairs.putTwo(packets[i] as Uint8Array, packets[i + 1] as Uint8Array);
      expect(pair).toEqual(results.slice(i, i + 2));
    }
    if (packets.length % 2 === 1) inPairs.put(packets.at(-1) as Uint8Array);
    const samples = surface.samples.slice();
    expect(samples).toEqual(inPairs.samples);
    const columns = Math.ceil(size.width / 16);
    expect(samples).toHaveLength(columns * Math.ceil(size.height / 16) * TILE_SAMPLES);
    let seen = 0;
    samples.forEach((sample, i) => {
      const tile = Math.floor(i / TILE_SAMPLES);
      const u = (tile % columns) * 16 + (i % 16);
      const v = Math.floor(tile / columns) * 16 + (Math.floor(i / 16) % 16);
      const isInside = u < size.width && v < size.height;
      const depth = isInside ? (images.depth[v * size.width + u] as number) : 0;
      if (!isInside) expect(sample).toBe(0);
      else if (depth === 0) {
        // What was not seen is filled in beside what was, and not farther.
        if (sample !== 0) expect(isBesideSeen(images.depth, u, v)).toBe(true);
      } else {
        seen++;
        const bits = sample & 0xffff;
        const inverse = 2 ** ((bits >> 10) - 15) * (1 + (bits & 1023) / 1024);
        expect(Math.abs(inverse * depth - 1)).toBeLessThan(1 / 2048);
        const rgba = images.colour[v * size.width + u] as number;
        const bits565 = ((rgba & 0xf8) << 8) | ((rgba >> 5) & 0x7e0) | ((rgba >> 19) & 31);
        expect(sample >>> 16).toBe(bits565);
      }
    });
    expect(seen).toBe(report.points);
    // Each tile comes once; those that nobody sent are empty.
    const covered = new Set<number>();
    for (const result of results) {
      if ('fault' in result) expect.unreachable(result.fault);
      for (let tile = result.firstTile; tile < result.firstTile + result.tiles; tile++) {
        expect(covered.has(tile)).toBe(false);
        covered.add(tile);
      }
    }
    samples.forEach((sample, i) => {
      if (sample !== 0) expect(covered.has(Math.floor(i / TILE_SAMPLES))).toBe(true);
    });
    // Points again, from the next frame on.
    surface.surface = false;
    surface.begin();
    surface.put(packets[0] as Uint8Array);
    expect(surface.isSurface).toBe(false);
    expect(surface.unpack().length).toBeGreaterThan(0);
  });

  test('process two packets at once like one after the other, including refused ones', () => {
    const { header, packets } = encoded({ depthLevel: 0, colour: { quality: 0, chroma: 'full' } });
    expect(packets.length).toBeGreaterThan(2);
    const [a, b, c] = packets as [Uint8Array, Uint8Array, Uint8Array];
    const damaged = a.with(30, (a[30] as number) ^ 1);
    const long = new Uint8Array(1300);
    const pairs = [
      [damaged, a],
      [b, b],
      [long, c],
      [a.with(0, (a[0] as number) ^ 1), c.subarray(0, 9)],
    ] as const;
    const [atOnce, oneByOne] = [new OrganisedDecoder(codec, header), new OrganisedDecoder(codec, header)];
    const results = pairs.map(([first, second]) => atOnce.putTwo(first, second));
    expect(results).toEqual(pairs.map((pair) => pair.map((packet) => oneByOne.put(packet))));
    expect(results).toMatchObject([
      [{ fault: 'bad-check' }, { points: expect.any(Number) }],
      [{ points: expect.any(Number) }, { fault: 'duplicate' }],
      [{ fault: 'too-long' }, { points: expect.any(Number) }],
      [{ fault: 'bad-check' }, { fault: 'too-short' }],
    ]);
    expect(atOnce.unpack()).toEqual(oneByOne.unpack());
  });

  test('keep a budget and thin the farthest tiles first', () => {
    const whole = encoded({}).report;
    const budgetBytes = Math.round(whole.bytes / 6);
    const { report, header, packets } = encoded({ budgetBytes, thinning: { nearDistance: 3 } });
    expect(report.bytes).toBeLessThanOrEqual(budgetBytes + 1200);
    const decoder = new OrganisedDecoder(codec, header, { images: true });
    for (const packet of packets) decoder.put(packet);
    const kept = (from: number, to: number): number =>
      decoder.depth.subarray(from * size.width, to * size.width).filter((z) => z > 0).length;
    expect(kept(80, 90)).toBeGreaterThanOrEqual(kept(0, 10));
    expect(report.points + report.reasons.thinned + report.reasons.dropped).toBe(whole.points);
  });

  test('a latency test is pure green and costs less', () => {
    const { report, header, packets } = encoded({ latencyTest: true });
    expect(report.bytes).toBeLessThan(encoded({}).report.bytes);
    const decoder = new OrganisedDecoder(codec, header);
    for (const packet of packets) decoder.put(packet);
    expect(decoder.latencyTest).toBe(true);
    const words = new Uint16Array(decoder.unpack().slice().buffer);
    expect(words.filter((_, i) => i % 4 === 3).every((colour) => colour === 0x03f0)).toBe(true);
  });

  test('few colours are lossless with a palette', () => {
    const { header, packets } = encoded({ colour: 'palette' }, true);
    const decoder = new OrganisedDecoder(codec, header, { images: true });
    for (const packet of packets) decoder.put(packet);
    const seen = new Set(decoder.colour.filter((colour) => colour !== 0));
    expect(seen).toEqual(new Set([0xff20_4060, 0xff60_a0c0]));
  });

  test('the camera is found, and frames that do not fit it are refused', () => {
    const encoder = new OrganisedEncoder(codec, size);
    fill(encoder.frame, encoder.frameBits, plane);
    const found = encoder.estimateCamera();
    if (!found.fits) throw new Error(found.reason);
    expect(found.camera.fx).toBeCloseTo(camera.fx, 2);
    expect(found.camera.cy).toBeCloseTo(camera.cy, 2);
    expect(encoder.checkCamera(camera)).toEqual({ fits: true, camera });
    expect(encoder.checkCamera({ ...camera, fx: 110 })).toMatchObject({ fits: false, reason: 'off-grid' });
    encoder.frame.fill(Number.NaN);
    expect(encoder.estimateCamera()).toEqual({ fits: false, reason: 'too-few-points' });
  });

  test('images give the same result as points', () => {
    const { packets } = encoded({});
    const encoder = new OrganisedEncoder(codec, size);
    const { depth, colour } = encoder;
    for (let i = 0; i < depth.length; i++) {
      const [u, v] = [i % size.width, Math.floor(i / size.width)];
      depth[i] = plane(u, v);
      colour[i] = ((u >> 3) + (v >> 3)) % 2 === 0 ? 0xff20_4060 : 0xff60_a0c0;
    }
    encoder.begin(camera, { fromImages: true });
    const report = encoder.encode({ fromImages: true });
    expect(report.packets).toBe(packets.length);
    packets.forEach((packet, i) => {
      expect(encoder.packet(i)).toEqual(packet);
    });
  });

  test('packets of another stream and wrong calls are refused with a type', () => {
    const { encoder, header, packets } = encoded({});
    const packet = packets[0] ?? new Uint8Array();
    const next = new OrganisedDecoder(codec, encoder.begin(camera));
    expect(next.put(packet)).toEqual({ fault: 'unknown-stream' });
    expect(() => new OrganisedDecoder(codec, header.subarray(1))).toThrow(CodecError);
    expect(() => encoder.begin({ ...camera, fx: 0 })).toThrow(
      expect.objectContaining({ code: 'bad-parameter' }),
    );
    expect(() => encoder.encode({ depthLevel: 8 })).toThrow(
      expect.objectContaining({ code: 'bad-parameter' }),
    );
    const fresh = new OrganisedEncoder(codec, size);
    expect(() => fresh.encode()).toThrow(expect.objectContaining({ code: 'no-stream' }));
    expect(() => new OrganisedEncoder(codec, { width: 0, height: 4 })).toThrow(
      expect.objectContaining({ code: 'bad-capacity' }),
    );
  });
});

test('the conformance vectors give their points here, too', () => {
  const file = new URL('../vectors/organised.json', import.meta.url);
  const vectors = JSON.parse(readFileSync(file, 'utf8')) as {
    streamHeader: string;
    packets: { data: string; points: number[][] }[];
  }[];
  expect(vectors).toHaveLength(9);
  for (const { streamHeader, packets } of vectors) {
    const decoder = new OrganisedDecoder(codec, Buffer.from(streamHeader, 'hex'));
    for (const { data, points } of packets) {
      const start = decoder.count * 4;
      expect(decoder.put(Buffer.from(data, 'hex'))).toMatchObject({ points: points.length });
      const bytes = decoder.unpack().slice();
      const signed = new Int16Array(bytes.buffer).subarray(start);
      const colours = new Uint16Array(bytes.buffer).subarray(start);
      const got = points.map((_, i) => [...signed.subarray(4 * i, 4 * i + 3), colours[4 * i + 3]]);
      expect(got).toEqual(points);
    }
  }
});
