/** What the help lists: every key, button of a controller and gesture, grouped, as they are mapped now. Pure. */
import type { AxisRole, ButtonRole, ControllerMap } from '../drive/controller-map.ts';
import type { KeyMap, KeyRole } from '../drive/key-map.ts';
import { type Gesture, gestureWords, helpGroupTitles } from '../status/help-words.ts';
import { axisName, buttonName, keyName, keyRoleWords } from '../status/input-words.ts';

export interface HelpController {
  readonly name: string;
  readonly map: ControllerMap;
  /** Whether its axes and buttons have the usual names. */
  readonly isStandard: boolean;
}

export interface HelpRow {
  readonly what: string;
  /** What is written on each of its keys. */
  readonly keys: readonly string[];
  /** Of each controller that has it: its name, and its buttons and axes. */
  readonly controllers: readonly { readonly name: string; readonly parts: readonly string[] }[];
  /** How it is done by mouse or finger; `null` if it is not. */
  readonly hand: string | null;
}

export interface HelpGroup {
  readonly title: string;
  readonly rows: readonly HelpRow[];
}

type GroupName = keyof typeof helpGroupTitles;

/** Each role once, in the order in which people need them. */
export const GROUPS: readonly { readonly name: GroupName; readonly roles: readonly (KeyRole | Gesture)[] }[] =
  [
    { name: 'drive', roles: ['grip', 'forward', 'back', 'left', 'right', 'slower', 'faster', 'go-to'] },
    { name: 'stop', roles: ['estop', 'release'] },
    {
      name: 'views',
      roles: ['look', 'zoom', 'view', 'recentre', 'from-above', 'hazards', 'predict'],
    },
    { name: 'cameras', roles: ['enlarge', 'swap', 'move-panel', 'resize-panel'] },
    {
      name: 'panels',
      roles: ['dashboard', 'latency-test', 'talk', 'next-robot', 'save-scene', 'save-clip', 'help', 'close'],
    },
  ];

const buttonRoles: Readonly<Partial<Record<KeyRole, ButtonRole>>> = {
  ...{ grip: 'grip', estop: 'estop', release: 'release', 'latency-test': 'latencyTest' },
  ...{ 'next-robot': 'nextRobot', faster: 'faster', slower: 'slower' },
};
const axisRoles: Readonly<Partial<Record<KeyRole, AxisRole>>> = {
  ...{ forward: 'forward', back: 'back', left: 'left', right: 'left' },
};

/** @param oneHanded whether a key for a direction is the grip as well */
export function helpGroups(
  keys: KeyMap,
  oneHanded: boolean,
  controllers: readonly HelpController[],
): readonly HelpGroup[] {
  return GROUPS.map(({ name, roles }) => ({
    title: helpGroupTitles[name],
    rows: roles.map((role) =>
      isGesture(role)
        ? { what: gestureWords[role].what, keys: [], controllers: [], hand: gestureWords[role].hand }
        : rowOf(role, keys, oneHanded, controllers),
    ),
  }));
}

function rowOf(
  role: KeyRole,
  keys: KeyMap,
  oneHanded: boolean,
  controllers: readonly HelpController[],
): HelpRow {
  const byKeys = keys[role].map(keyName);
  return {
    what: keyRoleWords[role],
    keys: role === 'help' && !byKeys.includes('?') ? [...byKeys, '?'] : byKeys,
    controllers: controllers
      .map((controller) => ({ name: controller.name, parts: partsOf(role, controller) }))
      .filter(({ parts }) => parts.length > 0),
    hand:
      role === 'grip' && oneHanded
        ? `${gestureWords.grip.hand}; also any key for a direction`
        : (gestureWords[role as Gesture]?.hand ?? null),
  };
}

function partsOf(role: KeyRole, { map, isStandard }: HelpController): string[] {
  const button = buttonRoles[role];
  const buttons =
    button === undefined ? [] : map.buttons[button].map((index) => buttonName(index, isStandard));
  const axis = axisRoles[role];
  if (axis === undefined) return buttons;
  const axes = map.sticks.map((stick) =>
    // Without a pedal of its own, backward is the other way of forward.
    axis === 'back' ? (stick.back ?? stick.forward) : stick[axis],
  );
  const named = axes.flatMap((each) => (each === null ? [] : [axisName(each.axis, isStandard)]));
  return [...buttons, ...new Set(named)];
}

function isGesture(role: KeyRole | Gesture): role is Exclude<Gesture, KeyRole> {
  return !(role in keyRoleWords);
}
