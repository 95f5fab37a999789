import type { EmulatedLink } from '@farpoint/local-stack';
import type { GoalHold } from '@farpoint/protocol';
import type { GoalHand } from '../goal-hand.ts';
import type { SignaledOperator } from '../signaled-operator.ts';
import { BRAKES_MS, VIEW_MS } from './fault.ts';

/** A robot on its way to a goal, on which its driver holds on. */
export interface Going {
  driver: SignaledOperator;
  hand: GoalHand;
  link: EmulatedLink;
  connect(): Promise<SignaledOperator>;
}

/** Something that goes wrong on the way to a goal. */
export interface GoalFault {
  name: string;
  /** Why the goal has ended then, or any of these. */
  reasons: readonly string[];
  /** ms; default {@link BRAKES_MS}. */
  withinMs?: number;
  behindLink?: boolean;
  /** @returns when it began, if something had to be prepared before; performance.now(), ms */
  cause(going: Going): unknown;
}

const change = (more: (hold: GoalHold) => Partial<GoalHold>) => (hold: GoalHold) => ({
  ...hold,
  ...more(hold),
});
/** A round trip on the link, ms. */
const LINK_MS = 20;

/** The robot brakes, and the goal has ended: it does not go on although the driver holds on. */
export const goalFaults: GoalFault[] = [
  // The driver and its page.
  { name: 'the page falls silent', reasons: ['silence'], cause: ({ hand }) => hand.sends(() => null) },
  {
    name: 'the driver’s machine loses its power',
    reasons: ['silence'],
    cause: ({ driver }) => driver.client.vanish(),
  },
  {
    name: 'the control channel is closed',
    reasons: ['silence', 'lease-lost'],
    cause: ({ driver }) => void driver.client.control.close(),
  },
  {
    name: 'the lease is given back',
    reasons: ['lease-lost'],
    cause: ({ driver }) => driver.client.sendSession({ type: 'leaseRelease' }),
  },
  {
    name: 'another operator takes over',
    reasons: ['lease-lost'],
    cause: async ({ connect }) => {
      const other = await connect();
      const beganMs = performance.now();
      other.client.sendSession({ type: 'leaseRequest', take: true });
      return beganMs;
    },
  },
  {
    name: 'STOP on the control channel',
    reasons: ['estop'],
    cause: ({ driver }) => driver.client.sendControl({ type: 'estop', press: 1 }),
  },
  // Holds.
  {
    name: 'one hold, repeated',
    reasons: ['silence'],
    cause: ({ hand }) => {
      const { newest } = hand;
      hand.sends(() => newest);
    },
  },
  {
    name: 'holds in reverse order',
    reasons: ['silence'],
    cause: ({ hand }) => {
      const from = hand.newest?.sequence ?? 0;
      hand.sends(change(({ sequence }) => ({ sequence: Math.max(0, 2 * from - sequence) })));
    },
  },
  {
    name: 'holds that grow old',
    reasons: ['silence'],
    cause: ({ hand }) => {
      const timeMs = hand.newest?.timeMs ?? 0;
      hand.sends(change(() => ({ timeMs })));
    },
  },
  {
    name: 'a lease that is not its own',
    reasons: ['silence'],
    cause: ({ hand }) => hand.sends(change(() => ({ lease: 'x'.repeat(22) }))),
  },
  {
    name: 'holds of another goal',
    reasons: ['silence'],
    cause: ({ hand }) => hand.sends(change(({ goal }) => ({ goal: goal + 1 }))),
  },
  {
    name: 'rubbish on the control channel',
    reasons: ['silence'],
    cause: ({ hand }) => hand.sends(() => '{"type":"goalHold"'),
  },
  // What the driver sees.
  {
    name: 'the page draws nothing any more',
    reasons: ['view'],
    withinMs: VIEW_MS,
    cause: ({ hand }) => {
      const { seenUs } = hand.newest ?? {};
      hand.sends(change(() => ({ seenUs })));
    },
  },
  {
    name: 'the page no longer says what it draws',
    reasons: ['view'],
    withinMs: VIEW_MS,
    cause: ({ hand }) => hand.sends(change(() => ({ seenUs: undefined }))),
  },
  // The link.
  {
    name: 'the way to the robot is cut',
    behindLink: true,
    reasons: ['silence'],
    withinMs: BRAKES_MS + LINK_MS,
    cause: ({ link }) => link.tell({ type: 'blackhole', direction: 'down', active: true }),
  },
  {
    name: 'the way to the driver is cut',
    behindLink: true,
    reasons: ['view'],
    withinMs: VIEW_MS + LINK_MS,
    cause: ({ link }) => link.tell({ type: 'blackhole', direction: 'up', active: true }),
  },
];
