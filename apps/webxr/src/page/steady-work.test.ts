import { beforeEach, describe, expect, test, vi } from 'vitest';
import { SteadyWork, type SteadyWorkParts } from './steady-work.ts';

const order: string[] = [];
const page = { hidden: false, focus: true, hasFocus: () => page.focus };
let parts: ReturnType<typeof standIns>;
let work: SteadyWork;

/** Parts that write down what is called, in order. */
function standIns() {
  const called = <T = void>(name: string, result?: T) =>
    vi.fn((..._: unknown[]) => {
      order.push(name);
      return result as T;
    });
  return {
    client: { driver: { suspended: false, letGo: called('letGo') }, update: called('send') },
    inputs: { poll: called('poll') },
    estop: { update: called('estop') },
    cloudPanel: { update: called('cloudPanel') },
    near: { update: called('near') },
    vr: { active: { value: false }, hidden: false },
    state: {
      driving: { role: { value: 'drive' } },
      looking: { value: false },
      sample: called('sample'),
      followSilence: called('silence'),
    },
    stats: { update: called('stats'), remembered: null as unknown },
    views: {
      cloud: {},
      remembered: { updateMap: called('map', 'a map') },
      videoColour: { update: called('colour') },
      videos: { measure: called('videos') },
    },
    frames: { measureGap: called('gap'), govern: called('govern') },
    showRobot: called('robot'),
  };
}

beforeEach(() => {
  order.length = 0;
  Object.assign(page, { hidden: false, focus: true });
  parts = standIns();
  work = new SteadyWork(parts as unknown as SteadyWorkParts, page);
});

const isSuspended = () => {
  work.drive(0);
  return parts.client.driver.suspended;
};

describe('the hands', () => {
  test('are read before commands are sent, and the robot is drawn where it is then', () => {
    work.drive(40);
    expect(order).toEqual(['gap', 'poll', 'estop', 'send', 'silence', 'robot', 'near']);
    expect(parts.client.update).toHaveBeenCalledWith(40);
    expect(parts.estop.update).toHaveBeenCalledWith(40, false);
  });

  test.each([
    ['the page is hidden', () => Object.assign(page, { hidden: true })],
    ['keys go elsewhere', () => Object.assign(page, { focus: false })],
    ['the operator only watches', () => Object.assign(parts.state.driving.role, { value: 'watch' })],
    ['the headset is off', () => Object.assign(parts.vr, { active: { value: true }, hidden: true })],
  ])('drive nothing while %s', (_, happens) => {
    expect(isSuspended()).toBe(false);
    happens();
    expect(isSuspended()).toBe(true);
  });

  test('drive in the headset, although the page is hidden behind it', () => {
    Object.assign(parts.vr, { active: { value: true } });
    Object.assign(page, { hidden: true, focus: false });
    expect(isSuspended()).toBe(false);
  });

  test('that have lost the page’s keys keep the lease; a page that stays hidden gives it back', () => {
    page.focus = false;
    for (let nowMs = 0; nowMs < 60_000; nowMs += 25) work.drive(nowMs);
    expect(order).not.toContain('letGo');
    page.hidden = true;
    for (let nowMs = 60_000; nowMs < 120_000; nowMs += 25) work.drive(nowMs);
    expect(order.filter((call) => call === 'letGo')).toHaveLength(1);
  });
});

describe('the state for people', () => {
  test('is taken after everything has been measured', () => {
    work.report(250);
    expect(order).toEqual(['stats', 'map', 'colour', 'videos', 'sample', 'cloudPanel', 'govern']);
    expect(parts.stats.remembered).toBe('a map');
  });

  test.each([
    [false, false, true],
    [true, false, false],
    [true, true, true],
  ])('page hidden: %s, in the headset: %s, somebody looks: %s', (hidden, inVr, looks) => {
    page.hidden = hidden;
    parts.vr.active.value = inVr;
    work.report(0);
    expect(parts.state.looking.value).toBe(looks);
  });
});
