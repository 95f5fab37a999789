import { always, BRAKES_MS, change, type Fault, forward, VIEW_MS, withVelocity } from './fault.ts';

/** A round trip on the link, which is the robot's: `up` carries pictures, `down` commands. */
const LINK_MS = 20;

/** The robot brakes, and nothing moves again while the hand holds on. */
export const brakingFaults: Fault[] = [
  // The operator's hand and page.
  { name: 'the page falls silent', cause: ({ hand }) => hand.sends(() => null) },
  { name: 'the connection is closed', cause: ({ operator }) => void operator.close() },
  { name: 'the operator’s machine loses its power', cause: ({ operator }) => operator.vanish() },
  { name: 'the control channel is closed', cause: ({ operator }) => void operator.closeControl() },
  {
    name: 'the grip is let go and the stick held',
    cause: ({ hand }) => hand.sends(change(() => ({ deadMan: false }))),
  },
  {
    name: 'the hand is not read any more',
    cause: ({ hand }) => hand.sends(change(() => ({ unread: true }))),
  },
  { name: 'the stick is let go', cause: ({ hand }) => hand.letGoOfStick() },
  {
    name: 'the lease is given back',
    cause: ({ operator }) => operator.sendSession({ type: 'leaseRelease' }),
  },
  {
    name: 'another operator takes over',
    cause: async ({ rig }) => (await rig.connect()).sendSession({ type: 'leaseRequest', take: true }),
  },
  // STOP.
  {
    name: 'STOP on the session channel',
    cause: ({ operator }) => operator.sendSession({ type: 'estop', latch: true }),
  },
  {
    name: 'STOP on the control channel',
    cause: ({ operator }) => {
      // Any may be lost: a page repeats the press until it is acknowledged.
      for (let i = 0; i < 3; i++) operator.sendControl({ type: 'estop', press: 1 });
    },
  },
  // Commands.
  {
    name: 'one command, repeated',
    cause: ({ hand }) => {
      const { newest } = hand;
      hand.sends(() => newest);
    },
  },
  {
    name: 'commands in reverse order',
    cause: ({ hand }) => {
      const from = hand.newest?.sequence ?? 0;
      hand.sends(change(({ sequence }) => ({ sequence: Math.max(0, 2 * from - sequence) })));
    },
  },
  {
    name: 'readings that grow old',
    cause: ({ hand }) => {
      const timeMs = hand.newest?.timeMs ?? 0;
      hand.sends(change(() => ({ timeMs })));
    },
  },
  {
    name: 'the operator’s clock jumps back by 10 s',
    cause: ({ hand }) => hand.sends(change(({ timeMs }) => ({ timeMs: Math.max(0, timeMs - 10_000) }))),
  },
  {
    name: 'the operator’s clock runs at a tenth',
    withinMs: BRAKES_MS,
    cause: ({ hand }) => {
      const from = hand.newest?.timeMs ?? 0;
      hand.sends(change(({ timeMs }) => ({ timeMs: from + (timeMs - from) / 10 })));
    },
  },
  {
    name: 'a lease that is not its own',
    cause: ({ hand }) => hand.sends(change(() => ({ lease: 'x' }))),
  },
  {
    name: 'five times the limit',
    cause: ({ hand }) => hand.sends(change(() => ({ twist: forward(5) }))),
  },
  {
    name: 'an axis that the robot does not have',
    cause: ({ hand }) =>
      hand.sends(
        change(({ twist }) => ({
          twist: { ...twist, linear: { ...twist.linear, y: 0.1 } },
        })),
      ),
  },
  {
    name: 'velocities that are not numbers',
    cause: ({ hand }) => hand.sends(withVelocity('NaN')),
  },
  {
    name: 'infinite velocities',
    cause: ({ hand }) => hand.sends(withVelocity('1e999')),
  },
  {
    name: 'rubbish on the control channel',
    cause: ({ hand }) => hand.sends(always('{"type":"command"')),
  },
  { name: 'empty messages on the control channel', cause: ({ hand }) => hand.sends(always('')) },
  {
    name: 'messages of 60 kB on the control channel',
    cause: ({ hand }) => hand.sends(always('x'.repeat(60_000))),
  },
  {
    name: 'commands of another protocol',
    cause: ({ hand }) => hand.sends(always('{"linear":{"x":0.25},"angular":{"z":0}}')),
  },
  // What the driver sees.
  {
    name: 'the page draws nothing any more',
    settled: true,
    withinMs: VIEW_MS,
    cause: ({ hand }) => {
      const { seenUs } = hand.newest ?? {};
      hand.sends(change(() => ({ seenUs })));
    },
  },
  {
    name: 'the page no longer says what it draws',
    settled: true,
    withinMs: VIEW_MS,
    cause: ({ hand }) => hand.sends(change(() => ({ seenUs: undefined }))),
  },
  {
    name: 'what is drawn falls back by 3 s',
    settled: true,
    withinMs: VIEW_MS,
    cause: ({ hand }) => hand.sends(change(({ seenUs = 0 }) => ({ seenUs: (seenUs - 3_000_000) >>> 0 }))),
  },
  {
    name: 'what is drawn is from the future',
    settled: true,
    withinMs: VIEW_MS,
    cause: ({ hand }) => hand.sends(change(({ seenUs = 0 }) => ({ seenUs: (seenUs + 5_000_000) >>> 0 }))),
  },
  { name: 'the camera’s program is killed', settled: true, cause: ({ rig }) => rig.stopCamera() },
  // The link.
  {
    name: 'the network is cut',
    behindLink: true,
    cause: ({ rig }) => rig.link?.tell({ type: 'blackhole', direction: 'both', active: true }),
  },
  {
    name: 'the way to the robot is cut',
    behindLink: true,
    cause: ({ rig }) => rig.link?.tell({ type: 'blackhole', direction: 'down', active: true }),
  },
  {
    name: 'the way to the operator is cut',
    behindLink: true,
    settled: true,
    withinMs: VIEW_MS + LINK_MS,
    cause: ({ rig }) => rig.link?.tell({ type: 'blackhole', direction: 'up', active: true }),
  },
  {
    name: 'the link stands still',
    behindLink: true,
    cause: ({ rig }) => rig.link?.tell({ type: 'pause', direction: 'both', paused: true }),
  },
  {
    name: 'the delay jumps to 3 s',
    behindLink: true,
    cause: ({ rig }) => rig.link?.tell({ type: 'set', direction: 'both', delayMs: 3000 }),
  },
  {
    name: 'pictures come 3 s late',
    behindLink: true,
    settled: true,
    withinMs: VIEW_MS + LINK_MS,
    cause: ({ rig }) => rig.link?.tell({ type: 'set', direction: 'up', delayMs: 3000 }),
  },
  {
    name: 'the way to the operator is as narrow as 8 kbit/s',
    behindLink: true,
    settled: true,
    // The queue in the link still delivers pictures for some time.
    withinMs: VIEW_MS + 300,
    cause: ({ rig }) => rig.link?.tell({ type: 'set', direction: 'up', rateMbps: 0.008 }),
  },
  {
    name: 'every packet is lost',
    behindLink: true,
    cause: ({ rig }) => rig.link?.tell({ type: 'set', direction: 'both', loss: 1 }),
  },
  {
    name: 'the operator’s network changes its addresses',
    behindLink: true,
    withinMs: BRAKES_MS + 50,
    cause: ({ rig }) => void rig.link?.renumber(),
  },
];
