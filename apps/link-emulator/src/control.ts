/** Messages with which a parent process controls the link through Node's IPC channel. */
import { type Direction, directions, monotonicMs, type UdpLink } from '@farpoint/link-emulator';
import { type CapacitySpec, constantCapacity, type LinkProfile } from '@farpoint/network-sim';
import * as z from 'zod';

const direction = z.enum(['up', 'down', 'both']);

/** Every member that is present replaces the profile's value. Times in milliseconds. */
const controlSchema = z.discriminatedUnion('type', [
  z.strictObject({
    type: z.literal('set'),
    direction,
    /** When the change takes effect, on CLOCK_MONOTONIC; immediately if undefined. */
    atMs: z.number().optional(),
    /** `null`: no bottleneck. */
    rateMbps: z.number().min(0).nullable().optional(),
    delayMs: z.number().optional(),
    jitterMs: z.number().optional(),
    loss: z.number().optional(),
    queueMs: z.number().optional(),
    queueBytes: z.number().optional(),
  }),
  z.strictObject({ type: z.literal('pause'), direction, paused: z.boolean() }),
  z.strictObject({ type: z.literal('blackhole'), direction, active: z.boolean() }),
  /** Restores the options, and sets second 0 of traces, steps and outages to now. */
  z.strictObject({ type: z.literal('reset') }),
]);
export type ControlMessage = z.infer<typeof controlSchema>;

/**
 * @param initial the link as described by the options
 * @throws {z.ZodError | ProfileError | CapacityError} the link is then unchanged
 */
export function control(
  link: UdpLink,
  data: unknown,
  initial: Readonly<Record<Direction, LinkProfile>>,
): ControlMessage {
  const message = controlSchema.parse(data);
  link.advance();
  const nowMs = monotonicMs();
  if (message.type === 'reset') {
    for (const way of directions) link.models[way].setProfile(initial[way], nowMs);
  }
  const models =
    !('direction' in message) || message.direction === 'both'
      ? [link.models.up, link.models.down]
      : [link.models[message.direction]];
  for (const model of models) {
    if (message.type === 'reset') model.restart(nowMs);
    else if (message.type === 'pause') model.pause(message.paused, nowMs);
    else if (message.type === 'blackhole') model.blackhole(message.active, nowMs);
    else model.setProfile(patched(model.profile, message), message.atMs ?? nowMs);
  }
  link.advance();
  return message;
}

function patched(profile: LinkProfile, message: Extract<ControlMessage, { type: 'set' }>): LinkProfile {
  const { rateMbps, delayMs, jitterMs, loss, queueMs, queueBytes } = message;
  const capacity: CapacitySpec =
    rateMbps === undefined ? profile.capacity : constantCapacity(rateMbps ?? Number.POSITIVE_INFINITY);
  return {
    ...profile,
    capacity,
    ...(delayMs === undefined ? {} : { delayMs }),
    ...(jitterMs === undefined ? {} : { jitterMs }),
    ...(loss === undefined ? {} : { loss }),
    ...(queueMs === undefined ? {} : { queue: { ms: queueMs } }),
    ...(queueBytes === undefined ? {} : { queue: { bytes: queueBytes } }),
  };
}
