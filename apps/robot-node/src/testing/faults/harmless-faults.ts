import type { Command } from '@farpoint/protocol';
import { change, type Fault, forward } from './fault.ts';

/** The robot goes on: this is nobody's reason to stop. */
export const harmlessFaults: Fault[] = [
  {
    name: 'a second operator looks on',
    cause: async ({ rig }) => {
      await rig.connect();
    },
  },
  {
    name: 'a second operator asks for the lease politely',
    cause: async ({ rig }) => (await rig.connect()).sendSession({ type: 'leaseRequest', take: false }),
  },
  {
    name: 'a second operator sends commands without the lease',
    cause: async ({ rig, hand }) => {
      const other = await rig.connect();
      for (let i = 0; i < 20; i++) other.sendControl({ ...hand.make(), lease: 'guess', twist: forward(-1) });
    },
  },
  {
    name: 'a second operator sends rubbish',
    cause: async ({ rig }) => {
      const other = await rig.connect();
      for (let i = 0; i < 20; i++) other.sendText('{');
    },
  },
  {
    name: 'every command comes twice',
    cause: ({ hand, operator }) =>
      hand.sends((command) => {
        operator.sendControl(command);
        return command;
      }),
  },
  {
    name: 'a flood of old commands beside the fresh ones',
    cause: ({ hand, operator }) => {
      const old = hand.newest as Command;
      hand.sends((command) => {
        operator.sendControl(old);
        return command;
      });
    },
  },
  {
    name: 'the operator’s clock jumps ahead by an hour',
    cause: ({ hand }) => hand.sends(change(({ timeMs }) => ({ timeMs: timeMs + 3_600_000 }))),
  },
  {
    name: 'a twentieth of the packets is lost',
    behindLink: true,
    cause: ({ rig }) => rig.link?.tell({ type: 'set', direction: 'both', loss: 0.05 }),
  },
  {
    name: 'packets overtake each other',
    behindLink: true,
    cause: ({ rig }) => rig.link?.tell({ type: 'set', direction: 'both', jitterMs: 20 }),
  },
];
