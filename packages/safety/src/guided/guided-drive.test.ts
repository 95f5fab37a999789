import { type GoalPhase, type GoalReason, type Twist, zeroTwist } from '@farpoint/protocol';
import { beforeEach, describe, expect, test } from 'vitest';
import { type Goal, GuidedDrive } from './guided-drive.ts';
import { defaultGuidedOptions } from './guided-options.ts';

const velocity = (x: number, z = 0): Twist => ({
  ...zeroTwist(),
  linear: { x, y: 0, z: 0 },
  angular: { x: 0, y: 0, z },
});
const goal: Goal = { operatorId: 'ada', id: 1, x: 3, y: 0 };

let guided: GuidedDrive;
let told: [GoalPhase, GoalReason | null][];
let now: number;

/** Odometry, a hold and a velocity, every 25 ms. */
function run(ms: number, say: { hold?: boolean; at?: number; twist?: Twist | null } = {}): Twist | null {
  let twist: Twist | null = null;
  for (const end = now + ms; now < end; ) {
    now += 25;
    guided.moved({ x: say.at ?? 0, y: 0, yaw: 0 }, now);
    if (say.hold !== false) guided.hold('ada', 1, now);
    if (say.twist !== null) guided.navigate(say.twist ?? velocity(0.3), now);
    twist = guided.velocityAt(now);
  }
  return twist;
}

beforeEach(() => {
  now = 10_000;
  told = [];
  guided = new GuidedDrive({ ...defaultGuidedOptions, maxLinear: 1, maxAngular: 1.5, watchdogMs: 150 });
  guided.onState = (_, state, reason) => void told.push([state, reason]);
  guided.moved({ x: 0, y: 0, yaw: 0 }, now);
});

describe('a goal', () => {
  test('is driven to while it is held, and reached where the navigator stands', () => {
    expect(guided.begin(goal, now)).toBeNull();
    expect(run(200)).toEqual(velocity(0.3));
    expect(run(25, { at: 0.2, twist: velocity(0) })).toEqual(zeroTwist());
    for (let at = 0.5; at < 2.9; at += 0.05) run(50, { at });
    expect(run(50, { at: 2.9, twist: velocity(0) })).toBeNull();
    expect(told).toEqual([
      ['accepted', null],
      ['driving', null],
      ['reached', null],
    ]);
  });

  test('is nothing before it is held', () => {
    guided.begin(goal, now);
    expect(run(500, { hold: false })).toEqual(zeroTwist());
    expect(run(600, { hold: false })).toBeNull();
    expect(told.at(-1)).toEqual(['cancelled', 'silence']);
  });

  test('ends for good when nobody holds it for the watchdog’s time', () => {
    guided.begin(goal, now);
    run(500);
    expect(run(125, { hold: false })).toEqual(velocity(0.3));
    expect(run(25, { hold: false })).toBeNull();
    expect(told.at(-1)).toEqual(['cancelled', 'silence']);
    expect(run(500)).toBeNull();
  });

  test('ends for good even if the holds come again before anybody looks', () => {
    guided.begin(goal, now);
    run(100);
    expect(guided.hold('ada', 1, now + 200)).toBe(false);
    expect(guided.goal).toBeNull();
  });

  test('is held by its own operator and number only', () => {
    guided.begin(goal, now);
    expect(guided.hold('eve', 1, now)).toBe(false);
    expect(guided.hold('ada', 2, now)).toBe(false);
    expect(guided.hold('ada', 1, now)).toBe(true);
  });

  test('waits for a silent navigator, but not without end', () => {
    guided.begin(goal, now);
    run(500);
    expect(run(300, { twist: null })).toEqual(zeroTwist());
    expect(run(25)).toEqual(velocity(0.3));
    expect(run(10_050, { twist: null })).toBeNull();
    expect(told.at(-1)).toEqual(['cancelled', 'navigator-silent']);
  });

  test('ends when the robot gets nowhere', () => {
    guided.begin(goal, now);
    expect(run(21_000)).toBeNull();
    expect(told.at(-1)).toEqual(['blocked', 'no-progress']);
  });

  test('ends when odometry is silent, and when the pose jumps', () => {
    guided.begin(goal, now);
    guided.hold('ada', 1, now + 100);
    guided.hold('ada', 1, now + 200);
    guided.hold('ada', 1, now + 290);
    guided.navigate(velocity(0.3), now + 290);
    expect(guided.velocityAt(now + 301)).toBeNull();
    expect(told.at(-1)).toEqual(['cancelled', 'no-pose']);
    run(25);
    guided.begin({ ...goal, id: 2 }, now);
    guided.moved({ x: 0.5, y: 0, yaw: 0 }, now + 25);
    expect(told.at(-1)).toEqual(['cancelled', 'pose-jump']);
  });

  test.each<[string, Partial<Goal>, GoalReason]>([
    ['far', { x: 20.1 }, 'too-far'],
    ['no number', { x: Number.NaN }, 'too-far'],
    ['endless', { y: Number.NEGATIVE_INFINITY }, 'too-far'],
  ])('that is %s is refused', (_, part, reason) => {
    expect(guided.begin({ ...goal, ...part }, now)).toBe(reason);
    expect(guided.goal).toBeNull();
    expect(told).toEqual([]);
  });

  test('is refused if its number was used, if nobody knows where the robot is, and if the robot may not go there', () => {
    guided.begin({ ...goal, id: 7 }, now);
    expect(guided.begin({ ...goal, id: 7 }, now)).toBe('repeated');
    expect(guided.begin({ ...goal, id: 6 }, now)).toBe('repeated');
    expect(guided.begin({ ...goal, id: 8 }, now + 400)).toBe('no-pose');
    expect(told.at(-1)).toEqual(['cancelled', 'replaced']);
    guided.judge = ({ x }) => (x > 2 ? 'outside-fence' : null);
    expect(guided.begin({ ...goal, id: 9 }, now)).toBe('outside-fence');
    expect(guided.begin({ ...goal, id: 10, x: 1 }, now)).toBeNull();
  });
});

test('a velocity is bounded along its arc, and what the robot cannot do counts as zero', () => {
  guided.begin(goal, now);
  expect(run(100, { twist: velocity(4, 1) })).toEqual(velocity(1, 0.25));
  const wild: Twist[] = [
    velocity(Number.NaN),
    velocity(0.1, Number.POSITIVE_INFINITY),
    { ...velocity(0.5), linear: { x: 0.5, y: 0.2, z: 0 } },
  ];
  for (const twist of wild) {
    expect(guided.navigate(twist, now)).toBe(false);
    expect(guided.velocityAt(now)).toEqual(zeroTwist());
  }
});

test('a velocity from before the goal leads nowhere', () => {
  guided.begin(goal, now);
  guided.hold('ada', 1, now);
  guided.navigate(velocity(0.3), now - 1);
  expect(guided.velocityAt(now)).toEqual(zeroTwist());
});
