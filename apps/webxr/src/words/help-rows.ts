/** The rows of the help: every key, button, axis and gesture with what it does, grouped, as they are mapped now. */
import type { AxisRole, ButtonRole, ControllerMap } from '../take/drive/controller-map.ts';
import {
  KEY_ROLES,
  type KeyMap,
  type KeyRole,
  SIDEWAYS_ROLES,
  STOP_KEY_ALWAYS,
} from '../take/drive/key-map.ts';
import type { LaterTexts } from './en/later-catalogue.ts';
import { keyName } from './input-words.ts';
import { buttonName } from './inputs-dialog-words.ts';
import { laterTexts } from './language.ts';

export interface HelpController {
  readonly name: string;
  readonly map: ControllerMap;
  /** Whether the browser knows its axes and buttons. */
  readonly isStandard: boolean;
}

export interface HelpRow {
  readonly what: string;
  /** What is written on each of its keys. */
  readonly keys: readonly string[];
  /** Each controller that does it, and the buttons and axes with which it does. */
  readonly controllers: readonly { readonly name: string; readonly parts: readonly string[] }[];
  /** How mouse or finger do it; `null` if they cannot. */
  readonly hand: string | null;
}

export interface HelpGroup {
  readonly title: string;
  readonly rows: readonly HelpRow[];
}

type Gesture = keyof LaterTexts['help']['gestures'];

/** Each role and gesture once, in the order in which operators need them. */
export const HELP_GROUPS: Readonly<
  Record<keyof LaterTexts['help']['groups'], readonly (KeyRole | Gesture)[]>
> = {
  drive: ['grip', 'forward', 'back', 'left', 'right', ...SIDEWAYS_ROLES, 'slower', 'faster'],
  stop: ['estop', 'release'],
  views: ['look', 'zoom', 'recentre', 'view', 'from-above', 'hazards', 'predict'],
  cameras: ['enlarge', 'swap', 'movePanel', 'resizePanel'],
  people: ['talk', 'point', 'next-robot'],
  log: ['bookmark', 'events', 'picture', 'clip'],
  panels: ['dashboard', 'latency-test', 'help', 'fullScreen', 'close'],
};

const HANDS: Readonly<Partial<Record<KeyRole, keyof LaterTexts['help']['hands']>>> = {
  grip: 'grip',
  forward: 'ways',
  back: 'ways',
  left: 'ways',
  right: 'ways',
  slower: 'faster',
  faster: 'faster',
  estop: 'estop',
  release: 'release',
  recentre: 'recentre',
  view: 'view',
  'from-above': 'fromAbove',
  hazards: 'hazards',
  enlarge: 'enlarge',
  swap: 'swap',
  dashboard: 'dashboard',
  'latency-test': 'latencyTest',
  talk: 'talk',
  'next-robot': 'nextRobot',
  point: 'point',
  bookmark: 'bookmark',
  events: 'events',
  picture: 'picture',
  clip: 'clip',
  help: 'help',
};
const BUTTONS: Readonly<Partial<Record<KeyRole, ButtonRole>>> = {
  grip: 'grip',
  estop: 'estop',
  release: 'release',
  'latency-test': 'latencyTest',
  'next-robot': 'nextRobot',
  faster: 'faster',
  slower: 'slower',
};
const AXES: Readonly<Partial<Record<KeyRole, AxisRole>>> = {
  forward: 'forward',
  back: 'back',
  left: 'left',
  right: 'left',
  'sideways-left': 'sideways',
  'sideways-right': 'sideways',
};

/** @param goesSideways whether the robot can: otherwise what does that is left out */
export function helpGroups(
  keys: KeyMap,
  controllers: readonly HelpController[],
  goesSideways = true,
): readonly HelpGroup[] {
  const { groups } = laterTexts().help;
  const isSideways = new Set<KeyRole | Gesture>(SIDEWAYS_ROLES);
  return Object.entries(HELP_GROUPS).map(([name, roles]) => ({
    title: groups[name as keyof typeof HELP_GROUPS],
    rows: roles
      .filter((role) => goesSideways || !isSideways.has(role))
      .map((role) => (isKeyRole(role) ? keyRow(role, keys, controllers) : gestureRow(role))),
  }));
}

/** The buttons and axes with which a controller does this, by their names. */
export function controllerParts(role: KeyRole, { map, isStandard }: HelpController): readonly string[] {
  const button = BUTTONS[role];
  const names = button === undefined ? [] : map.buttons[button].map((index) => buttonName(index, isStandard));
  if (role === 'grip' && map.gripAxis !== null) names.push(axisName(map.gripAxis.axis, isStandard));
  const axis = AXES[role];
  if (axis === undefined) return names;
  for (const stick of map.sticks) {
    // Without a pedal of its own, the axis for driving forward also drives backward.
    const found = axis === 'back' ? (stick.back ?? stick.forward) : (stick[axis] ?? null);
    if (found !== null) names.push(axisName(found.axis, isStandard));
  }
  return [...new Set(names)];
}

function keyRow(role: KeyRole, keys: KeyMap, controllers: readonly HelpController[]): HelpRow {
  const { hands } = laterTexts().help;
  const hand = HANDS[role];
  const names = keys[role].map(keyName);
  if (role === 'estop') names.push(keyName(STOP_KEY_ALWAYS));
  if (role === 'help' && !names.includes('?')) names.push('?');
  return {
    what: laterTexts().inputsDialog.keyRoles[role],
    keys: names,
    controllers: controllers
      .map((controller) => ({ name: controller.name, parts: controllerParts(role, controller) }))
      .filter(({ parts }) => parts.length > 0),
    hand: hand === undefined ? null : hands[hand],
  };
}

function gestureRow(gesture: Gesture): HelpRow {
  const { gestures, hands } = laterTexts().help;
  return { what: gestures[gesture], keys: [], controllers: [], hand: hands[gesture] };
}

function axisName(axis: number, isStandard: boolean): string {
  const { sticks } = laterTexts().help;
  return (isStandard ? sticks[axis] : undefined) ?? laterTexts().inputsDialog.axis(axis + 1);
}

function isKeyRole(role: KeyRole | Gesture): role is KeyRole {
  return (KEY_ROLES as readonly string[]).includes(role);
}
