/**
 * The reference system's local WebSockets between its bridge and its web page: JSON text for control (8085) and
 * telemetry (8090); frames (8095) are N × 3 int16 coordinates, then N × u16 colours, little-endian, without a header.
 */
import * as z from 'zod/mini';
import { type Twist, twistSchema } from './geometry.ts';
import type { JsonCodec } from './json.ts';

const robotId = z.int().check(z.minimum(0), z.maximum(0xffffffff));

const pageToBridge = z.discriminatedUnion('type', [
  z.object({ type: z.literal('initBridge'), url: z.string().check(z.maxLength(2048)) }),
  z.object({ type: z.literal('updateRobots') }),
  z.object({ type: z.literal('switchRobot'), robotId }),
  z.object({ type: z.literal('switchMode'), mode: z.string().check(z.maxLength(64)) }),
]);
export type ReferencePageToBridge = z.infer<typeof pageToBridge>;

const bridgeToPage = z.discriminatedUnion('type', [
  z.object({
    type: z.literal('updateRobots'),
    /** Null if there are none. */
    robots: z.nullable(z.array(z.object({ id: robotId, name: z.string() }))),
  }),
  z.object({ type: z.literal('switchedRobot'), robotId }),
]);
export type ReferenceBridgeToPage = z.infer<typeof bridgeToPage>;

const bridgeTelemetry = z.object({ type: z.literal('command'), command: z.object(twistSchema.shape) });
export type ReferenceBridgeTelemetry = z.infer<typeof bridgeTelemetry>;

export const referencePageToBridgeCodec: JsonCodec<ReferencePageToBridge> = {
  what: 'reference message from page to bridge',
  schema: pageToBridge,
  maxBytes: 4096,
};
export const referenceBridgeToPageCodec: JsonCodec<ReferenceBridgeToPage> = {
  what: 'reference message from bridge to page',
  schema: bridgeToPage,
  maxBytes: 1_048_576,
};
export const referenceBridgeTelemetryCodec: JsonCodec<ReferenceBridgeTelemetry> = {
  what: 'reference command from page to bridge',
  schema: bridgeTelemetry,
  maxBytes: 1024,
};

/**
 * The reference system's control message: a bare twist, UTF-8 JSON sent as a binary message. `linear.z ≠ 0` requests a
 * latency-test frame and is no motion.
 */
export const referenceControlCodec: JsonCodec<Twist> = {
  what: 'reference control message',
  schema: z.object(twistSchema.shape),
  maxBytes: 1024,
};
