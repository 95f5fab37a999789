/** What an operator has chosen about keys, controllers and speed. The browser keeps it as text; it is checked here. */
import * as z from 'zod/mini';
import { DEAD_ZONES } from './axis-map.ts';
import {
  assignButton,
  BUTTON_ROLES,
  type ButtonRole,
  type ControllerMap,
  EMPTY_MAP,
  MOST_BUTTONS,
  STANDARD_MAP,
  STANDARD_STOP,
} from './controller-map.ts';
import { DEFAULT_KEYS, KEY_ROLES, type KeyMap, MOST_KEYS, usableKeys } from './key-map.ts';
import { usableShare } from './speed-choice.ts';

export interface InputChoices {
  readonly keys: KeyMap;
  /** A key for a direction is the grip as well. */
  readonly oneHanded: boolean;
  /** By {@link controllerKey}, those that were used last come last. */
  readonly controllers: ReadonlyMap<string, ControllerMap>;
  /** Share of the robot's greatest speed. */
  readonly speed: number;
}

export const DEFAULT_CHOICES: InputChoices = {
  keys: DEFAULT_KEYS,
  oneHanded: false,
  controllers: new Map(),
  speed: 1,
};

/** How many controllers a browser remembers. */
export const MOST_CONTROLLERS = 32;
const MOST_ID = 512;

/** A controller, as far as it identifies itself. */
export interface ControllerName {
  readonly id?: string | undefined;
  readonly mapping?: string | undefined;
}

/** By what a controller is remembered. The same one may have the standard mapping in one browser and none in another. */
export function controllerKey({ id, mapping }: ControllerName): string {
  return `${mapping === 'standard' ? 'standard' : 'raw'}:${id ?? ''}`.slice(0, MOST_ID);
}

export function isStandardKey(key: string): boolean {
  return key.startsWith('standard:');
}

/** What a controller does: what was set for it, or what is usual. */
export function mapOf({ controllers }: InputChoices, key: string): ControllerMap {
  return controllers.get(key) ?? (isStandardKey(key) ? STANDARD_MAP : EMPTY_MAP);
}

const level = z.number().check(z.minimum(-1), z.maximum(1));
const axis = z
  .object({
    axis: z.int().check(z.minimum(0), z.maximum(63)),
    centre: level,
    least: level,
    most: level,
    inverted: z.boolean(),
    deadZone: z.number().check(z.minimum(DEAD_ZONES.least), z.maximum(DEAD_ZONES.most)),
  })
  .check(z.refine(({ centre, least, most }) => least <= centre && centre <= most));
const stick = z.object({ forward: z.nullable(axis), back: z.nullable(axis), left: z.nullable(axis) });
const buttons = z.array(z.int().check(z.minimum(0), z.maximum(127))).check(z.maxLength(MOST_BUTTONS));
const controller = z.object({
  key: z.string().check(z.maxLength(MOST_ID), z.regex(/^(standard|raw):/)),
  sticks: z.array(stick).check(z.minLength(1), z.maxLength(2)),
  buttons: z.object(byRole(BUTTON_ROLES, buttons)),
});
const codes = z.optional(z.array(z.string().check(z.maxLength(32))).check(z.maxLength(MOST_KEYS)));
const schema = z.object({
  keys: z.object(byRole(KEY_ROLES, codes)),
  oneHanded: z.boolean(),
  controllers: z.array(z.unknown()).check(z.maxLength(MOST_CONTROLLERS)),
  speed: z.number(),
});

/** The defaults if the text is not what {@link choicesText} writes. A controller that cannot be used is left out. */
export function parseChoices(text: string | null): InputChoices {
  let value: unknown = null;
  try {
    value = JSON.parse(text ?? 'null');
  } catch {
    return DEFAULT_CHOICES;
  }
  const { success, data } = schema.safeParse(value);
  if (!success) return DEFAULT_CHOICES;
  const controllers = new Map<string, ControllerMap>();
  for (const stored of data.controllers) {
    const read = controller.safeParse(stored);
    if (read.success) controllers.set(read.data.key, usableMap(read.data, isStandardKey(read.data.key)));
  }
  const { keys, oneHanded, speed } = data;
  return { keys: usableKeys(keys), oneHanded, controllers, speed: usableShare(speed) };
}

/** What {@link parseChoices} reads. */
export function choicesText({ keys, oneHanded, controllers, speed }: InputChoices): string {
  const kept = [...controllers].slice(-MOST_CONTROLLERS);
  return JSON.stringify({
    ...{ keys, oneHanded, speed },
    controllers: kept.map(([key, map]) => ({ key, ...map })),
  });
}

/** No button has two roles: STOP comes first, and the button that stops on every standard controller does. */
function usableMap({ sticks, buttons }: ControllerMap, isStandard: boolean): ControllerMap {
  let map: ControllerMap = { ...EMPTY_MAP, sticks };
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
