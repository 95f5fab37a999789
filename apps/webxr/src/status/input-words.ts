/** Words about keys, controllers and the speed that the operator chooses. */
import type { AxisRole, ButtonRefusal, ButtonRole } from '../drive/controller-map.ts';
import type { KeyRefusal, KeyRole } from '../drive/key-map.ts';

export const keyRoleWords: Readonly<Record<KeyRole, string>> = {
  estop: 'STOP',
  grip: 'Grip (hold to drive)',
  forward: 'Forward',
  back: 'Backward',
  left: 'Left',
  right: 'Right',
  slower: 'Lower gear',
  faster: 'Higher gear',
  release: 'Release STOP (hold)',
  talk: 'Talk (hold)',
  'latency-test': 'Latency test',
  recentre: 'Centre the view',
  view: 'First or third person',
  'from-above': 'From above',
  hazards: 'Hazards',
  enlarge: 'Enlarge a camera',
  dashboard: 'Dashboard',
  swap: 'Camera instead of cloud',
  'go-to': 'Go to',
  predict: 'Predicted view',
  'next-robot': 'Next robot',
  'save-scene': 'Save the picture',
  'save-clip': 'Save the last 30 seconds',
  help: 'Help',
};

export const buttonRoleWords: Readonly<Record<ButtonRole, string>> = {
  grip: keyRoleWords.grip,
  estop: keyRoleWords.estop,
  release: keyRoleWords.release,
  latencyTest: keyRoleWords['latency-test'],
  nextRobot: keyRoleWords['next-robot'],
  faster: keyRoleWords.faster,
  slower: keyRoleWords.slower,
};

export const axisRoleWords: Readonly<Record<AxisRole, string>> = {
  forward: 'Forward',
  back: 'Backward (a pedal of its own)',
  left: 'Left',
};

/** What to do with the axis so that it is recognised. */
export const axisPrompts: Readonly<Record<AxisRole, string>> = {
  forward: 'Push it forward all the way (or press the pedal), then let go.',
  back: 'Press the pedal for driving backward all the way, then let go.',
  left: 'Move it to the left all the way, then let go.',
};

const KEY_NAMES: Readonly<Record<string, string>> = {
  ArrowUp: '↑',
  ArrowDown: '↓',
  ArrowLeft: '←',
  ArrowRight: '→',
  Comma: ',',
  Period: '.',
  Slash: '/',
  Backslash: '\\',
  Semicolon: ';',
  Quote: "'",
  Minus: '-',
  Equal: '=',
  BracketLeft: '[',
  BracketRight: ']',
  Backquote: '`',
};

/** @param code KeyboardEvent.code @returns what is written on this key of a US keyboard */
export function keyName(code: string): string {
  const named = KEY_NAMES[code];
  if (named !== undefined) return named;
  const letter = /^(?:Key|Digit)(.)$/.exec(code)?.[1];
  if (letter !== undefined) return letter;
  const sided = /^(.+)(Left|Right)$/.exec(code);
  if (sided !== null) return `${sided[2]} ${sided[1]}`;
  return code.replaceAll(/(?<=[a-z])(?=[A-Z0-9])/g, ' ');
}

const STANDARD_BUTTONS = [
  ...['A', 'B', 'X', 'Y', 'LB', 'RB', 'LT', 'RT', 'Back', 'Start', 'left stick', 'right stick'],
  ...['pad ↑', 'pad ↓', 'pad ←', 'pad →', 'Home'],
] as const;
const STANDARD_AXES = ['left stick ↔', 'left stick ↕', 'right stick ↔', 'right stick ↕'] as const;

/** @param isStandard whether the browser knows what is written on it */
export function buttonName(button: number, isStandard: boolean): string {
  return (isStandard ? STANDARD_BUTTONS[button] : undefined) ?? `button ${button + 1}`;
}

/** @param isStandard whether the browser knows which stick it is */
export function axisName(axis: number, isStandard: boolean): string {
  return (isStandard ? STANDARD_AXES[axis] : undefined) ?? `axis ${axis + 1}`;
}

export function keyRefusalWords(code: string, refusal: KeyRefusal): string {
  const name = keyName(code);
  switch (refusal.reason) {
    case 'stops':
      return `${name} always stops the robot: it can have no other use.`;
    case 'taken':
      return `${name} is taken: ${keyRoleWords[refusal.by]}. Remove it there first.`;
    case 'reserved':
      return `${name} is needed to use the page without a mouse: choose another key.`;
    case 'full':
      return 'No further key fits here: remove one first.';
  }
}

/** @param button its index; shown counted from 1 */
export function buttonRefusalWords(button: number, refusal: ButtonRefusal): string {
  switch (refusal.reason) {
    case 'taken':
      return `Button ${button + 1} is taken: ${buttonRoleWords[refusal.by]}. Remove it there first.`;
    case 'full':
      return 'No further button fits here: remove one first.';
    case 'keeps-stop':
      return `Button ${button + 1} keeps stopping the robot. Others can be added to it.`;
  }
}

/** What is the matter with a controller; `null` if it can drive. */
export function controllerWords(isUnknown: boolean, canDrive: boolean): string | null {
  if (canDrive) return null;
  return isUnknown
    ? 'This browser does not know what its axes and buttons are: set them below. It does nothing until then.'
    : 'It cannot drive yet: it needs a grip and an axis.';
}

/** An axis that did not move while it was measured. */
export function stillWords(still: readonly number[]): string {
  if (still.length === 0) return 'Measured.';
  const names = still.map((axis) => axis + 1).join(', ');
  return `Measured, but for ${still.length === 1 ? 'axis' : 'axes'} ${names}: not moved.`;
}

export const controllerNotices = {
  unknown: (name: string) => `${name}: choose what it does under Settings, Keys and controllers`,
  unplugged: (name: string) => `${name} was unplugged: it has let go`,
} as const;

/** What a controller calls itself, without the numbers of its maker. */
export function controllerName(id: string | undefined): string {
  const name = (id ?? '').replace(/\s*\((?:STANDARD GAMEPAD\s*)?(?:Vendor:.*)?\)\s*$/i, '').trim();
  return name === '' ? 'Controller' : name.slice(0, 60);
}

/** @param maxLinear the most that the robot ever drives, m/s; 0 while it is not known */
export function speedShareWords(share: number, maxLinear: number): string {
  const percent = `${Math.round(share * 100)} %`;
  return maxLinear > 0 ? `${percent} · ${(share * maxLinear).toFixed(2)} m/s` : percent;
}
