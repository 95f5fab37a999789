/** What a parent process may say over Node's IPC channel while the link runs. */
import { type Direction, directions, monotonicMs, type UdpLink } from '@farpoint/link-emulator';
import { type CapacitySpec, constantCapacity, type LinkProfile } from '@farpoint/network-sim';
import * as z from 'zod';

const direction = z.enum(['up', 'down', 'both']);

/** Every member that is there replaces the profile's. Times in milliseconds. */
export const controlSchema = z.discriminatedUnion('type', [
  z.strictObject({
    type: z.literal('set'),
    direction,
    /** From when on, on CLOCK_MONOTONIC; at once where left out. */
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
  /** The second 0 of traces, steps and outages is now. */
  z.strictObject({ type: z.literal('restart') }),
  /** As the options have it again, and second 0 is now. */
  z.strictObject({ type: z.literal('reset') }),
]);
export type ControlMessage = z.infer<typeof controlSchema>;

/**
 * @param initial the link as the options have it
 * @throws {z.ZodError | ProfileError | CapacityError} leaving the link as it was
 */
export function control(
  link: UdpLink,
  data: unknown,
  initial: Readonly<Record<Direction, LinkProfile>>,
): ControlMessage {
  const message = controlSchema.parse(data);
  link.tick();
  const nowMs = monotonicMs();
  if (message.type === 'reset') {
    for (const way of directions) link.models[way].setProfile(initial[way], nowMs);
  }
  const models =
    !('direction' in message) || message.direction === 'both'
      ? [link.models.up, link.models.down]
      : [link.models[message.direction]];
  for (const model of models) {
    if (message.type === 'restart' || message.type === 'reset') model.restart(nowMs);
    else if (message.type === 'pause') model.pause(message.paused, nowMs);
    else if (message.type === 'blackhole') model.blackhole(message.active, nowMs);
    else model.setProfile(patched(model.profile, message), message.atMs ?? nowMs);
  }
  link.tick();
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
