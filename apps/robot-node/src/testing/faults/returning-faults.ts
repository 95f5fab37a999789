import { BRAKES_MS, type Driving, type Fault } from './fault.ts';
import { HungThread } from './hung-thread.ts';

export interface ReturningFault extends Fault {
  /** Whether the wheels are told nothing meanwhile. */
  silent?: boolean;
  ends(driving: Driving): void | Promise<void>;
}

/** A thread of the robot's program stands still for a while. */
function hung(name: string): Pick<ReturningFault, 'cause' | 'ends'> {
  let thread: HungThread | null = null;
  return {
    cause: async ({ rig, hand }) => {
      thread = await HungThread.seize(rig.robot.pid, name);
      await rig.untilSettled(hand);
      // Finding the thread takes long, and the robot may brake before its standing still is reported.
      const causeMs = performance.now();
      await thread.stop();
      return causeMs;
    },
    ends: () => thread?.goOn(),
  };
}

/** Need {@link canHangThreads}. */
export const hangingFaults: ReturningFault[] = [
  { name: 'the capture thread hangs', withinMs: BRAKES_MS, ...hung('capture') },
  // A native thread of the robot's then tells the wheels, once.
  { name: 'the main thread hangs', withinMs: BRAKES_MS, silent: true, ...hung('MainThread') },
];

/** The cause goes away with the hand held on: nothing moves until it has let go. */
export const returningFaults: ReturningFault[] = [
  {
    name: 'a gap of half a second in the commands',
    cause: ({ hand }) => hand.sends(() => null),
    ends: ({ hand }) => hand.sends((command) => command),
  },
  {
    name: 'a camera that was away',
    cause: ({ rig }) => rig.stopCamera(),
    ends: ({ rig }) => rig.startCamera(),
  },
  {
    name: 'a network that was away',
    behindLink: true,
    cause: ({ rig }) => rig.link?.tell({ type: 'blackhole', direction: 'both', active: true }),
    ends: ({ rig }) => rig.link?.tell({ type: 'blackhole', direction: 'both', active: false }),
  },
  {
    name: 'pictures that were late',
    behindLink: true,
    cause: ({ rig }) => rig.link?.tell({ type: 'blackhole', direction: 'up', active: true }),
    ends: ({ rig }) => rig.link?.tell({ type: 'blackhole', direction: 'up', active: false }),
  },
  {
    name: 'STOP, released',
    cause: ({ operator }) => operator.client.sendSession({ type: 'estop', latch: true }),
    ends: async ({ operator }) => {
      const { client } = operator;
      await client.message('estop', ({ latched }) => latched);
      client.releaseEstop();
      await client.message('estop', ({ latched }) => !latched);
    },
  },
];
