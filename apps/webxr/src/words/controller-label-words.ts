/** What each control of the headset's controllers does now, for the labels on them. */
import type { Hand, HeadsetView } from '../ground/headset-settings.ts';
import { laterTexts } from './language.ts';

export const CONTROLS = ['stick', 'stickPress', 'upper', 'lower', 'trigger', 'grip'] as const;
export type Control = (typeof CONTROLS)[number];

export interface LabelFacts {
  /** There is a session, and a robot is chosen at all. */
  readonly live: boolean;
  readonly chosen: boolean;
  /** The operator's grant allows no more than to watch. */
  readonly watches: boolean;
  readonly otherDrives: boolean;
  readonly latched: boolean;
  /** Whether this operator may release the stop. */
  readonly mayRelease: boolean;
  /** The grip is held, and drives. */
  readonly gripped: boolean;
  /** The grip must be opened first. */
  readonly mustLetGo: boolean;
  /** The menu is open. */
  readonly menu: boolean;
  /** Others see where this operator points. */
  readonly mayPoint: boolean;
  /** What points once it is opened or pulled; `null`: no hand aims. */
  readonly aims: 'grip' | 'trigger' | null;
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

/** `null` for a control that does nothing now. */
export type ControlWords = Readonly<Record<Control, string | null>>;

/** The letters on the two buttons of a controller. */
const LETTERS = { right: { lower: 'A', upper: 'B' }, left: { lower: 'X', upper: 'Y' } } as const;

/**
 * @param hand in which the controller is
 * @param drives whether that hand drives; the other one has the view
 */
export function controlWords(facts: LabelFacts, hand: Hand, drives: boolean): ControlWords {
  const said = laterTexts().controllerLabels;
  const { lower, upper } = LETTERS[hand];
  const always = {
    upper: facts.chosen ? (facts.latched ? said.stopIsOn(upper) : said.stop(upper)) : null,
  };
  if (facts.menu) {
    return {
      stick: said.upAndDown,
      stickPress: null,
      lower: said.closeMenu(lower),
      trigger: said.choose,
      grip: drives && mayDrive(facts) ? said.closeAndDrive : null,
      ...always,
    };
  }
  return drives
    ? { ...drivingWords(facts), ...always, lower: facts.gripped ? null : said.menu(lower) }
    : { ...viewWords(facts), ...always, lower: said.nextView(lower) };
}

function mayDrive({ live, latched, watches }: LabelFacts): boolean {
  return live && !latched && !watches;
}

type HandWords = Omit<ControlWords, 'upper' | 'lower'>;

function drivingWords(facts: LabelFacts): HandWords {
  const said = laterTexts().controllerLabels;
  const { gripped, nextRobot } = facts;
  const steer = gripped ? said.steer : said.steerWithGrip;
  return {
    grip: gripWords(facts),
    stick: mayDrive(facts) ? steer : null,
    stickPress: nextRobot === null || gripped ? null : said.connect(nextRobot),
    trigger: gripped ? null : triggerWords(facts),
  };
}

function gripWords({ live, latched, watches, otherDrives, mustLetGo, gripped }: LabelFacts): string | null {
  const said = laterTexts().controllerLabels;
  if (!live || latched) return null;
  if (watches) return said.onlyWatch;
  if (mustLetGo) return said.letGoFirst;
  if (gripped) return said.letGo;
  return otherDrives ? said.otherDrives : said.drive;
}

function viewWords(facts: LabelFacts): HandWords {
  const said = laterTexts().controllerLabels;
  return {
    grip: facts.mayPoint ? (facts.aims === 'grip' ? said.pointHere : said.point) : null,
    stick: facts.turns ? said.turn : null,
    stickPress: said.recentre,
    trigger: facts.gripped ? (facts.speaks ? said.speak : null) : triggerWords(facts),
  };
}

function triggerWords({ aims, latched, mayRelease, view, pictures }: LabelFacts): string | null {
  const said = laterTexts().controllerLabels;
  if (aims === 'trigger') return said.pointByTrigger;
  if (latched) return mayRelease ? said.release : null;
  if (view === 'tabletop') return said.holdModel;
  return pictures ? said.enlarge : null;
}
