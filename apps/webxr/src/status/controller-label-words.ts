/** What each control of the headset's controllers does now, for the labels on them. */
import type { HeadsetView } from '../headset/rig-pose.ts';

export const CONTROLS = ['stick', 'stickPress', 'upper', 'lower', 'trigger', 'grip'] as const;
export type Control = (typeof CONTROLS)[number];

/** Of the hand that drives, and of the one that has the view. */
export type HandRole = 'drives' | 'views';

export interface LabelFacts {
  /** There is a session, and the robot is chosen at all. */
  readonly live: boolean;
  readonly chosen: boolean;
  /** The operator's grant allows no more than to watch. */
  readonly watches: boolean;
  readonly otherDrives: boolean;
  readonly latched: boolean;
  readonly atRobot: boolean;
  /** The grip is held, and drives. */
  readonly gripped: boolean;
  /** The grip must be opened first. */
  readonly mustLetGo: boolean;
  readonly menu: boolean;
  readonly view: HeadsetView;
  /** A camera's picture is shown that a trigger can enlarge. */
  readonly pictures: boolean;
  /** The robot takes the operator's voice. */
  readonly speaks: boolean;
  /** The other hand's stick turns the view. */
  readonly turns: boolean;
  /** `null` if there is no other robot. */
  readonly nextRobot: string | null;
}

export type ControlWords = Readonly<Record<Control, string | null>>;

/** The letters on the two buttons of a controller. */
const LETTERS = { right: { lower: 'A', upper: 'B' }, left: { lower: 'X', upper: 'Y' } } as const;

/** @param hand in which the controller is; @returns `null` for a control that does nothing now */
export function controlWords(facts: LabelFacts, hand: 'left' | 'right', role: HandRole): ControlWords {
  const { lower, upper } = LETTERS[hand];
  const stop = facts.latched ? 'STOP is on' : 'STOP';
  const always = { upper: facts.chosen ? `${upper}: ${stop}` : null };
  if (facts.menu) {
    return {
      ...{ stick: 'Stick: up, down', stickPress: 'Press stick: choose', ...always },
      ...{ lower: `${lower}: close the menu`, trigger: 'Trigger: choose', grip: null },
    };
  }
  return role === 'drives'
    ? { ...drivingWords(facts), ...always, lower: `${lower}: ${facts.chosen ? 'menu' : 'menu, robots'}` }
    : { ...viewWords(facts), ...always, lower: `${lower}: next view` };
}

function drivingWords(facts: LabelFacts): Omit<ControlWords, 'upper' | 'lower'> {
  const { live, latched, gripped, watches, nextRobot } = facts;
  const drives = live && !latched && !watches;
  return {
    grip: gripWords(facts),
    stick: drives ? (gripped ? 'Stick: steer' : 'Stick: steer, with the grip') : null,
    stickPress: nextRobot === null || gripped ? null : `Press stick: ${nextRobot}`,
    trigger: gripped ? null : triggerWords(facts),
  };
}

function gripWords({ live, latched, watches, otherDrives, mustLetGo, gripped }: LabelFacts): string | null {
  if (!live || latched) return null;
  if (watches) return 'You only watch';
  if (mustLetGo) return 'Let go, then squeeze: drive';
  if (gripped) return 'Let go: the robot stops';
  return otherDrives ? 'Someone else drives: see the menu' : 'Squeeze: drive';
}

function viewWords(facts: LabelFacts): Omit<ControlWords, 'upper' | 'lower'> {
  return {
    grip: null,
    stick: facts.turns ? 'Stick: turn the view' : null,
    stickPress: 'Press stick: recentre',
    trigger: facts.gripped ? (facts.speaks ? 'Trigger: speak' : null) : triggerWords(facts),
  };
}

function triggerWords({ latched, atRobot, view, pictures }: LabelFacts): string | null {
  if (latched) return atRobot ? null : 'Hold 1 s: release STOP';
  if (view === 'tabletop') return 'Trigger: hold the model';
  return pictures ? 'Trigger at a picture: enlarge' : null;
}
