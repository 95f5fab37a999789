/** What the axes and buttons of a controller do: a gamepad, a wheel with pedals, a joystick. Pure. */
import { type AxisMap, DEAD_ZONES } from './axis-map.ts';

/** The axes with which one hand drives. Those that are `null` do nothing. */
export interface StickMap {
  /** Forward positive; backward as well, if the axis goes both ways. */
  readonly forward: AxisMap | null;
  /** A pedal of its own for driving backward. */
  readonly back: AxisMap | null;
  /** To the left positive. */
  readonly left: AxisMap | null;
}

export const AXIS_ROLES = ['forward', 'back', 'left'] as const;
export type AxisRole = (typeof AXIS_ROLES)[number];

/** What a button can do. `grip` is the dead-man grip: nothing drives without it. */
export const BUTTON_ROLES = [
  'grip',
  'estop',
  'release',
  'latencyTest',
  'nextRobot',
  'faster',
  'slower',
] as const;
export type ButtonRole = (typeof BUTTON_ROLES)[number];

export interface ControllerMap {
  /** The stick that is deflected the most drives. */
  readonly sticks: readonly StickMap[];
  /** Indexes of the buttons with each role. No button has two. */
  readonly buttons: Readonly<Record<ButtonRole, readonly number[]>>;
}

/** The most buttons that one role may have. */
export const MOST_BUTTONS = 4;
/** On a controller in the standard mapping this button (B, or a circle) stops, whatever else is set. */
export const STANDARD_STOP = 1;

const usual = (axis: number): AxisMap => {
  return { axis, centre: 0, least: -1, most: 1, inverted: true, deadZone: DEAD_ZONES.usual };
};

/** Either stick, while a shoulder button or a trigger is held. */
export const STANDARD_MAP: ControllerMap = {
  sticks: [
    { forward: usual(1), back: null, left: usual(0) },
    { forward: usual(3), back: null, left: usual(2) },
  ],
  buttons: {
    grip: [4, 5, 6, 7],
    estop: [STANDARD_STOP],
    release: [3],
    latencyTest: [0],
    nextRobot: [9],
    faster: [12],
    slower: [13],
  },
};

/** Of a controller whose axes and buttons nobody has named: it does nothing. */
export const EMPTY_MAP: ControllerMap = {
  sticks: [{ forward: null, back: null, left: null }],
  buttons: { grip: [], estop: [], release: [], latencyTest: [], nextRobot: [], faster: [], slower: [] },
};

/** Whether the controller can drive: it has a grip and an axis. */
export function canDrive({ sticks, buttons }: ControllerMap): boolean {
  return buttons.grip.length > 0 && sticks.some(({ forward, left }) => forward !== null || left !== null);
}

/** Why a button does not get a role, or does not lose it. */
export type ButtonRefusal =
  | { readonly reason: 'taken'; readonly by: ButtonRole }
  | { readonly reason: 'full' }
  | { readonly reason: 'keeps-stop' };

export type ButtonChange = { readonly map: ControllerMap } | ButtonRefusal;

/** Gives a button a role. @param button its index */
export function assignButton(map: ControllerMap, role: ButtonRole, button: number): ButtonChange {
  const by = BUTTON_ROLES.find((other) => map.buttons[other].includes(button));
  if (by === role) return { map };
  if (by !== undefined) return { reason: 'taken', by };
  if (map.buttons[role].length >= MOST_BUTTONS) return { reason: 'full' };
  return { map: withButtons(map, role, [...map.buttons[role], button]) };
}

/** Takes a role from a button. The last button that stops keeps its role, and so does {@link STANDARD_STOP}. */
export function removeButton(
  map: ControllerMap,
  role: ButtonRole,
  button: number,
  isStandard: boolean,
): ButtonChange {
  const rest = map.buttons[role].filter((other) => other !== button);
  if (role === 'estop' && (rest.length === 0 || (isStandard && button === STANDARD_STOP)))
    return { reason: 'keeps-stop' };
  return { map: withButtons(map, role, rest) };
}

/** Gives an axis a role on one of the sticks; `null` takes it away. */
export function withAxis(
  map: ControllerMap,
  stick: number,
  role: AxisRole,
  axis: AxisMap | null,
): ControllerMap {
  const sticks = map.sticks.map((was, index) => (index === stick ? { ...was, [role]: axis } : was));
  return { ...map, sticks };
}

function withButtons(map: ControllerMap, role: ButtonRole, buttons: readonly number[]): ControllerMap {
  return { ...map, buttons: { ...map.buttons, [role]: buttons } };
}
