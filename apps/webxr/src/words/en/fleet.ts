/** Several robots, and several people at one: what the list says about each robot, and what is pointed at. */
import type { RobotState } from '@farpoint/protocol';

export const fleet = {
  /** What a robot does. @param since when it began, as text */
  state: {
    free: (since: string) => `Free since ${since}`,
    driven: (since: string) => `In use since ${since}`,
    stopped: (since: string) => `STOP on since ${since}`,
    fault: (since: string) => `Wheels not responding since ${since}`,
  } satisfies Record<RobotState, (since: string) => string>,
  drives: (driver: string, since: string) => `Driven by ${driver} since ${since}`,
  alarms: (count: number) => (count === 1 ? '1 alarm' : `${count} alarms`),
  battery: (percent: number) => `Battery ${percent} %`,
  operators: (here: number, most: number) => `${here} of ${most} operators`,
  full: (here: number) => `Full: ${here} operators`,
  /** Of those operators. */
  watching: (count: number) => `${count} watching`,
  version: (version: string) => `Version ${version}`,
  search: 'Find a robot by name or id',
  found: (shown: number, all: number) => `${shown} of ${all} robots`,
  seen: {
    justNow: 'Seen here just now',
    minutes: (count: number) => `Seen here ${count} min ago`,
    hours: (count: number) => `Seen here ${count} h ago`,
  },
  /** About a spot that an operator of the same robot points at, and that the others see. */
  pointing: {
    /** Beside the ring on the floor. */
    you: 'You',
    somebody: 'Somebody',
    /** What there is to do. */
    aim: 'Point at the floor: move the mouse over it and press G, or click it with Alt held.',
    aimFinger: 'Point at the floor: hold a finger on it.',
    aimRay: 'Point the ray at the floor.',
    /** Why nothing is shown to the others. */
    notPermitted: 'Your grant lets you watch this robot, but not point.',
    notPassedOn: 'This robot does not show other operators where you point.',
    alone: 'Nobody else is connected who could see where you point.',
  },
};
