import { expect, test } from 'vitest';
import * as z from 'zod/mini';
import { encodeJsonBytes } from '../json.ts';
import { MAX_SIGNALING_BYTES, type RobotToService, robotToServiceCodec } from './farpoint.ts';

const offerOf = (sdp: string): RobotToService => ({ type: 'session.offer', session: 's1', sdp });

test('an SDP is bounded, and the largest fits a message', () => {
  const longest = offerOf('x'.repeat(60_000));
  expect(z.safeParse(robotToServiceCodec.schema, longest).success).toBe(true);
  expect(encodeJsonBytes(robotToServiceCodec, longest).length).toBeLessThan(MAX_SIGNALING_BYTES);
  expect(z.safeParse(robotToServiceCodec.schema, offerOf('x'.repeat(60_001))).success).toBe(false);
});
