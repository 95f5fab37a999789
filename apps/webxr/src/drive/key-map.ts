/** What the keys of a keyboard do. Keys are named by `KeyboardEvent.code`: by their place, not by their letter. Pure. */

/** What a key can do. `grip` is the dead-man grip. */
export const KEY_ROLES = [
  'estop',
  'grip',
  'forward',
  'back',
  'left',
  'right',
  'slower',
  'faster',
  'release',
  'talk',
  'latency-test',
  'recentre',
  'view',
  'from-above',
  'hazards',
  'enlarge',
  'dashboard',
  'swap',
  'go-to',
  'predict',
  'next-robot',
  'save-scene',
  'save-clip',
  'help',
] as const;
export type KeyRole = (typeof KEY_ROLES)[number];

export type KeyMap = Readonly<Record<KeyRole, readonly string[]>>;

/** Stops the robot, always: it can be given nothing else to do. */
export const STOP_KEY = 'KeyX';
/** The most keys that one role may have. */
export const MOST_KEYS = 4;

export const DEFAULT_KEYS: KeyMap = {
  estop: [STOP_KEY],
  grip: ['Space', 'ShiftLeft', 'ShiftRight'],
  forward: ['KeyW', 'ArrowUp'],
  back: ['KeyS', 'ArrowDown'],
  left: ['KeyA', 'ArrowLeft'],
  right: ['KeyD', 'ArrowRight'],
  slower: ['Comma'],
  faster: ['Period'],
  release: ['KeyR'],
  talk: ['KeyM'],
  'latency-test': ['KeyL'],
  recentre: ['KeyC'],
  view: ['KeyV'],
  'from-above': ['KeyT'],
  hazards: ['KeyH'],
  enlarge: ['KeyE'],
  dashboard: ['KeyB'],
  swap: ['KeyF'],
  'go-to': ['KeyG'],
  predict: ['KeyP'],
  'next-robot': ['KeyN'],
  'save-scene': ['KeyO'],
  'save-clip': ['KeyJ'],
  help: ['Slash'],
};

/** Keys with which pages, browsers and systems are used without a mouse. */
const RESERVED =
  /^(Tab|Escape|Enter|NumpadEnter|ContextMenu|PrintScreen|(Control|Alt|Meta|OS)(Left|Right)?|F\d{1,2}|CapsLock|NumLock|ScrollLock)$/;
const CODE = /^[A-Z][A-Za-z0-9]{0,31}$/;

/** Whether any key may be named so: neither reserved nor nonsense. */
export function isFreeKey(code: string): boolean {
  return CODE.test(code) && !RESERVED.test(code);
}

/** Why a key does not get a role, or does not lose it. */
export type KeyRefusal =
  | { readonly reason: 'stops' }
  | { readonly reason: 'taken'; readonly by: KeyRole }
  | { readonly reason: 'reserved' }
  | { readonly reason: 'full' };

export type KeyChange = { readonly keys: KeyMap } | KeyRefusal;

export function roleOf(keys: KeyMap, code: string): KeyRole | undefined {
  return KEY_ROLES.find((role) => keys[role].includes(code));
}

/** Gives a key a role. */
export function assignKey(keys: KeyMap, role: KeyRole, code: string): KeyChange {
  const by = roleOf(keys, code);
  if (by === role) return { keys };
  if (code === STOP_KEY) return { reason: 'stops' };
  if (!isFreeKey(code)) return { reason: 'reserved' };
  if (by !== undefined) return { reason: 'taken', by };
  if (keys[role].length >= MOST_KEYS) return { reason: 'full' };
  return { keys: { ...keys, [role]: [...keys[role], code] } };
}

/** Takes a role from a key. {@link STOP_KEY} keeps stopping. */
export function removeKey(keys: KeyMap, role: KeyRole, code: string): KeyChange {
  if (code === STOP_KEY) return { reason: 'stops' };
  return { keys: { ...keys, [role]: keys[role].filter((other) => other !== code) } };
}

/**
 * The usable part of what was stored. Of two roles for a key the first counts; roles that are missing have their usual
 * keys, as far as those are free.
 */
export function usableKeys(
  stored: Readonly<Partial<Record<KeyRole, readonly string[] | undefined>>>,
): KeyMap {
  let keys: KeyMap = { ...emptyKeys, estop: [STOP_KEY] };
  const give = (role: KeyRole, codes: readonly string[] | undefined) => {
    for (const code of codes ?? []) {
      const change = assignKey(keys, role, code);
      if ('keys' in change) keys = change.keys;
    }
  };
  for (const role of KEY_ROLES) give(role, stored[role]);
  for (const role of KEY_ROLES) if (stored[role] === undefined) give(role, DEFAULT_KEYS[role]);
  return keys;
}

const emptyKeys = Object.fromEntries(KEY_ROLES.map((role) => [role, []])) as unknown as KeyMap;
