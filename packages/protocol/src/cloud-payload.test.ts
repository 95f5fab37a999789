import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { type CloudPayloadFault, MAX_CLOUD_PAYLOAD_BYTES, readCloudPayload } from './cloud-payload.ts';
import type { Quaternion, Vector3 } from './geometry.ts';
import { emptyPlacement } from './placement.ts';
import { emptyPointPacketHeader, type PointPacketHeader } from './point-packet.ts';
import { readVectors } from './testing/vectors.ts';

interface Vector {
  name: string;
  hex: string;
  header?: PointPacketHeader;
  placement?: { position: Vector3; orientation: Quaternion; captureTimeUs: number };
  fault?: CloudPayloadFault;
}
const { payloads } = readVectors<{ payloads: Vector[] }>('cloud-payload');

function read(bytes: Uint8Array) {
  const header = emptyPointPacketHeader();
  const placement = emptyPlacement();
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  return { fault: readCloudPayload(view, header, placement), header, placement };
}

describe('conformance vectors', () => {
  test.each(payloads)('$name', (vector) => {
    const { fault, header, placement } = read(Buffer.from(vector.hex, 'hex'));
    expect(fault).toBe(vector.fault ?? null);
    if (vector.header === undefined || vector.placement === undefined) return;
    expect(header).toEqual(vector.header);
    const { position, orientation, ...rest } = vector.placement;
    expect(placement).toEqual({ pose: { position, orientation }, ...rest });
  });
});

test('a full payload fits a packet of 1,500 bytes with all headers', () => {
  expect(MAX_CLOUD_PAYLOAD_BYTES).toBe(1244);
  expect(Math.max(...payloads.filter((v) => v.fault === undefined).map((v) => v.hex.length / 2))).toBe(1244);
});

test('a valid payload with any byte changed, cut or added gives a fault or a block inside it', () => {
  const good = payloads.filter(({ fault }) => fault === undefined);
  const faults = new Set<string | null>();
  fc.assert(
    fc.property(
      fc.constantFrom(...good),
      fc.oneof(fc.nat(15), fc.nat(1300)),
      fc.nat(255),
      fc.integer({ min: -40, max: 40 }),
      fc.boolean(),
      ({ hex }, at, byte, grow, resize) => {
        const source = Buffer.from(hex, 'hex');
        const bytes = new Uint8Array(Math.max(source.length + (resize ? grow : 0), 0));
        bytes.set(source.subarray(0, bytes.length));
        if (at < bytes.length) bytes[at] = byte;
        const { fault, header, placement } = read(bytes);
        faults.add(fault);
        if (fault !== null) return;
        expect(header.sequenceOffset + header.sequenceLength).toBeLessThanOrEqual(header.frameLength);
        if (placement.format === 'points64') expect(16 + header.sequenceLength + 28).toBe(bytes.length);
        else expect(bytes.length).toBeGreaterThan(16 + 28);
      },
    ),
    { seed: 1, numRuns: 5000 },
  );
  for (const fault of [null, 'too-short', 'trailing-bytes', 'unknown-format', 'bad-length', 'bad-offset']) {
    expect(faults).toContain(fault);
  }
});
