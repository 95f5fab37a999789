/** What the axes and buttons of a device do: a gamepad, a wheel with pedals, a joystick. Pure. */
import { type AxisMap, DEAD_ZONES } from './axis-map.ts';

/** The axes with which one hand drives. Those that are `null` do nothing. */
export interface StickMap {
  /** Forward positive; backward as well, if the axis goes both ways. */
  readonly forward: AxisMap | null;
  /** A pedal of its own for driving backward. */
  readonly back: AxisMap | null;
  /** Turning, to the left positive. */
  readonly left: AxisMap | null;
  /** Sideways, to the left positive: it counts beside whichever stick drives. Left out: none does. */
  readonly sideways?: AxisMap | null | undefined;
}

/** `sideways` exists only with a robot whose base can. */
export const AXIS_ROLES = ['forward', 'back', 'left', 'sideways'] as const;
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
  /** A pedal or lever that is the grip while it is pressed; `null`: only buttons are. */
  readonly gripAxis: AxisMap | null;
}

/** The most buttons that one role may have. Chosen: as many as a gamepad has at its shoulders; controller-map.test.ts holds it. */
export const MOST_BUTTONS = 4;
/** On a device in the standard mapping this button (B, or a circle) stops, whatever else is set. */
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
  gripAxis: null,
};

/** Of a device whose axes and buttons nobody has named: it does nothing. */
export const EMPTY_MAP: ControllerMap = {
  sticks: [{ forward: null, back: null, left: null }],
  buttons: { grip: [], estop: [], release: [], latencyTest: [], nextRobot: [], faster: [], slower: [] },
  gripAxis: null,
};

/** What a device lacks to drive: the dead-man grip comes first; `null`: it can drive. */
export function missingOf({ sticks, buttons, gripAxis }: ControllerMap): 'grip' | 'axis' | null {
  if (buttons.grip.length === 0 && gripAxis === null) return 'grip';
  return sticks.some(({ forward, left }) => forward !== null || left !== null) ? null : 'axis';
}

/** Why a button or an axis does not get a role, or does not lose it. */
export type MapRefusal =
  | { readonly reason: 'taken'; readonly by: ButtonRole | AxisRole }
  | { readonly reason: 'full' }
  | { readonly reason: 'keeps-stop' };

export type MapChange = { readonly map: ControllerMap } | MapRefusal;

/** Gives a button a role. @param button its index */
export function assignButton(map: ControllerMap, role: ButtonRole, button: number): MapChange {
  const by = BUTTON_ROLES.find((other) => map.buttons[other].includes(button));
  if (by === role) return { map };
  if (by !== undefined) return { reason: 'taken', by };
  if (map.buttons[role].length >= MOST_BUTTONS) return { reason: 'full' };
  return { map: withButtons(map, role, [...map.buttons[role], button]) };
}

/** Takes a role from a button. On a device in the standard mapping {@link STANDARD_STOP} keeps stopping. */
export function removeButton(
  map: ControllerMap,
  role: ButtonRole,
  button: number,
  isStandard: boolean,
): MapChange {
  if (role === 'estop' && isStandard && button === STANDARD_STOP) return { reason: 'keeps-stop' };
  const rest = map.buttons[role].filter((other) => other !== button);
  return { map: withButtons(map, role, rest) };
}

/** Gives an axis a role on one of the sticks; `null` takes it away. An axis has one role on a stick. */
export function assignAxis(
  map: ControllerMap,
  stick: number,
  role: AxisRole,
  axis: AxisMap | null,
): MapChange {
  if (axis !== null && axis.axis === map.gripAxis?.axis) return { reason: 'taken', by: 'grip' };
  const others = AXIS_ROLES.filter((other) => other !== role);
  const by = others.find((other) => axis !== null && map.sticks[stick]?.[other]?.axis === axis.axis);
  if (by !== undefined) return { reason: 'taken', by };
  const sticks = map.sticks.map((was, index) => (index === stick ? { ...was, [role]: axis } : was));
  return { map: { ...map, sticks } };
}

/** Makes an axis the grip. One that drives is refused: whoever holds the grip must be able to stand still. */
export function assignGripAxis(map: ControllerMap, axis: AxisMap | null): MapChange {
  if (axis !== null)
    for (const stick of map.sticks) {
      const by = AXIS_ROLES.find((role) => stick[role]?.axis === axis.axis);
      if (by !== undefined) return { reason: 'taken', by };
    }
  return { map: { ...map, gripAxis: axis } };
}

function withButtons(map: ControllerMap, role: ButtonRole, buttons: readonly number[]): ControllerMap {
  return { ...map, buttons: { ...map.buttons, [role]: buttons } };
}
