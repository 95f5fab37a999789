import type { Driving, Fault } from './fault.ts';

export interface ReturningFault<Driven extends Driving = Driving> extends Fault<Driven> {
  /** Whether the wheels are told nothing meanwhile. */
  silent?: boolean;
  ends(driving: Driven): void | Promise<void>;
}

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
    cause: ({ operator }) => operator.sendSession({ type: 'estop', latch: true }),
    ends: async ({ operator }) => {
      await operator.estop(true);
      operator.releaseEstop();
      await operator.estop(false);
    },
  },
];
