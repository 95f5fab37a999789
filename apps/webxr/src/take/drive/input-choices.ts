/** What an operator has chosen about keys, devices and speed. The browser keeps it as text; it is checked here. */
import * as z from 'zod/mini';
import { DEAD_ZONES } from './axis-map.ts';
import {
  AXIS_ROLES,
  assignButton,
  BUTTON_ROLES,
  type ButtonRole,
  type ControllerMap,
  EMPTY_MAP,
  MOST_BUTTONS,
  missingOf,
  STANDARD_STOP,
} from './controller-map.ts';
import { DEFAULT_KEYS, KEY_ROLES, type KeyMap, MOST_KEYS, usableKeys } from './key-map.ts';
import { usableShare } from './speed-choice.ts';

export interface InputChoices {
  readonly keys: KeyMap;
  /** By {@link controllerKey}; those that were set last come last. */
  readonly controllers: ReadonlyMap<string, ControllerMap>;
  /** Share of the robot's greatest speed. */
  readonly speed: number;
}

export const DEFAULT_CHOICES: InputChoices = { keys: DEFAULT_KEYS, controllers: new Map(), speed: 1 };

/** How many devices a browser remembers. Chosen: more than anybody has; input-choices.test.ts holds it. */
export const MOST_CONTROLLERS = 32;
/** The most characters by which a device is remembered. Chosen: browsers' own names are shorter than 200. */
const MOST_ID = 512;

/** A device, as far as it identifies itself. */
export interface ControllerName {
  readonly id?: string | undefined;
  readonly mapping?: string | undefined;
}

/** By what a device is remembered. The same one may have the standard mapping in one browser and none in another. */
export function controllerKey({ id, mapping }: ControllerName): string {
  return `${mapping === 'standard' ? 'standard' : 'raw'}:${id ?? ''}`.slice(0, MOST_ID);
}

export function isStandardKey(key: string): boolean {
  return key.startsWith('standard:');
}

const level = z.number().check(z.minimum(-1), z.maximum(1));
/** Browsers tell of fewer axes and buttons than these indexes. */
const [MOST_AXIS, MOST_BUTTON] = [63, 127];
const axis = z
  .object({
    axis: z.int().check(z.minimum(0), z.maximum(MOST_AXIS)),
    centre: level,
    least: level,
    most: level,
    inverted: z.boolean(),
    deadZone: z.number().check(z.minimum(DEAD_ZONES.least), z.maximum(DEAD_ZONES.most)),
  })
  .check(z.refine(({ centre, least, most }) => least <= centre && centre <= most));
const stick = z.object({
  forward: z.nullable(axis),
  back: z.nullable(axis),
  left: z.nullable(axis),
  sideways: z.optional(z.nullable(axis)),
});
const buttons = z.array(z.int().check(z.minimum(0), z.maximum(MOST_BUTTON))).check(z.maxLength(MOST_BUTTONS));
const controller = z.object({
  key: z.string().check(z.maxLength(MOST_ID), z.regex(/^(standard|raw):/)),
  sticks: z.array(stick).check(z.minLength(1), z.maxLength(2)),
  buttons: z.object(byRole(BUTTON_ROLES, buttons)),
  gripAxis: z.nullable(axis),
});
const codes = z.catch(
  z.optional(z.array(z.string().check(z.maxLength(32))).check(z.maxLength(MOST_KEYS))),
  undefined,
);
const schema = z.object({
  keys: z.catch(z.object(byRole(KEY_ROLES, codes)), {}),
  controllers: z.catch(z.array(z.unknown()), []),
  speed: z.catch(z.number(), DEFAULT_CHOICES.speed),
});

/**
 * Reads what {@link choicesText} writes. What cannot be used is left out, and nothing else with it: a role then has its usual
 * keys, and a device is as if nobody had set it up. So is a device without a grip.
 */
export function parseChoices(text: string | null): InputChoices {
  const { keys, controllers: stored, speed } = schema.parse(objectOf(text));
  const controllers = new Map<string, ControllerMap>();
  for (const each of stored.slice(-MOST_CONTROLLERS)) {
    const read = controller.safeParse(each);
    if (!read.success) continue;
    const map = usableMap(read.data, isStandardKey(read.data.key));
    if (missingOf(map) === null) controllers.set(read.data.key, map);
  }
  return { keys: usableKeys(keys), controllers, speed: usableShare(speed) };
}

/** What {@link parseChoices} reads. */
export function choicesText({ keys, controllers, speed }: InputChoices): string {
  const kept = [...controllers].slice(-MOST_CONTROLLERS);
  return JSON.stringify({ keys, speed, controllers: kept.map(([key, map]) => ({ key, ...map })) });
}

function objectOf(text: string | null): object {
  try {
    const value: unknown = JSON.parse(text ?? '{}');
    return typeof value === 'object' && value !== null && !Array.isArray(value) ? value : {};
  } catch {
    return {};
  }
}

/** No button has two roles: STOP comes first, and the button that stops on every standard gamepad does. No grip drives. */
function usableMap({ sticks, buttons, gripAxis }: ControllerMap, isStandard: boolean): ControllerMap {
  const drives = sticks.some((each) =>
    AXIS_ROLES.some((role) => each[role] != null && each[role].axis === gripAxis?.axis),
  );
  let map: ControllerMap = { ...EMPTY_MAP, sticks, gripAxis: drives ? null : gripAxis };
  const give = (role: ButtonRole, index: number) => {
    const change = assignButton(map, role, index);
    if ('map' in change) map = change.map;
  };
  if (isStandard) give('estop', STANDARD_STOP);
  for (const role of ['estop', ...BUTTON_ROLES] as const)
    for (const index of buttons[role]) give(role, index);
  return map;
}

function byRole<Role extends string, Kind>(roles: readonly Role[], kind: Kind): Record<Role, Kind> {
  return Object.fromEntries(roles.map((role) => [role, kind])) as Record<Role, Kind>;
}
