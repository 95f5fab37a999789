import { BRAKES_MS } from './fault.ts';
import type { RealDriving } from './fault-rig.ts';
import { HungThread } from './hung-thread.ts';
import type { ReturningFault } from './returning-faults.ts';

export type HangingFault = ReturningFault<RealDriving>;

/** A thread of the robot's program stands still for a while. */
function hung(name: string): Pick<HangingFault, 'cause' | 'ends'> {
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
export const hangingFaults: HangingFault[] = [
  { name: 'the capture thread hangs', withinMs: BRAKES_MS, ...hung('capture') },
  // A native thread of the robot's then tells the wheels, once.
  { name: 'the main thread hangs', withinMs: BRAKES_MS, silent: true, ...hung('MainThread') },
];
