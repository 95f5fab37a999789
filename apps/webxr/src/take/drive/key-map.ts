/** What the keys of a keyboard do. Keys are named by `KeyboardEvent.code`: by their place, not by their letter. Pure. */

/** Roles that exist only with a robot whose base goes sideways. */
export const SIDEWAYS_ROLES = ['sideways-left', 'sideways-right'] as const;

/** What a key can do. `grip` is the dead-man grip. */
export const KEY_ROLES = [
  'estop',
  'grip',
  'forward',
  'back',
  'left',
  'right',
  'sideways-left',
  'sideways-right',
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
  'predict',
  'bookmark',
  'events',
  'picture',
  'clip',
  'next-robot',
  'point',
  'help',
] as const;
export type KeyRole = (typeof KEY_ROLES)[number];

/** What a key does while it is held. */
const HELD_ROLES = [
  'grip',
  'forward',
  'back',
  'left',
  'right',
  ...SIDEWAYS_ROLES,
  'release',
  'talk',
] as const;
/** What a key does at once. */
export type Action = Exclude<KeyRole, (typeof HELD_ROLES)[number]>;

export function isAction(role: KeyRole): role is Action {
  return !(HELD_ROLES as readonly KeyRole[]).includes(role);
}

export type KeyMap = Readonly<Record<KeyRole, readonly string[]>>;

/** Stops the robot wherever the focus is, whatever else is chosen: it writes nothing, and browsers leave it to the page. */
export const STOP_KEY_ALWAYS = 'F9';
/** Stops where nobody has chosen another key. */
const USUAL_STOP_KEY = 'KeyX';
/** The most keys that one role may have. Chosen: the grip has three, and a numeric keypad adds one; key-map.test.ts holds it. */
export const MOST_KEYS = 4;

export const DEFAULT_KEYS: KeyMap = {
  estop: [USUAL_STOP_KEY],
  grip: ['Space', 'ShiftLeft', 'ShiftRight'],
  forward: ['KeyW', 'ArrowUp'],
  back: ['KeyS', 'ArrowDown'],
  left: ['KeyA', 'ArrowLeft'],
  right: ['KeyD', 'ArrowRight'],
  'sideways-left': ['Comma'],
  'sideways-right': ['Period'],
  slower: ['BracketLeft'],
  faster: ['BracketRight'],
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
  predict: ['KeyP'],
  bookmark: ['KeyK'],
  events: ['KeyJ'],
  picture: ['KeyO'],
  clip: ['KeyU'],
  'next-robot': ['KeyN'],
  point: ['KeyG'],
  help: ['Slash'],
};

/**
 * All keys lie under one hand. The thumb or the little finger holds the grip while the other fingers drive, and STOP is in reach
 * of the same hand. Chosen by the places of the keys on ISO and ANSI keyboards; key-map.test.ts holds that they are usable.
 */
export const KEY_PRESETS = {
  both: DEFAULT_KEYS,
  left: {
    estop: [USUAL_STOP_KEY],
    grip: ['Space', 'ShiftLeft'],
    forward: ['KeyW'],
    back: ['KeyS'],
    left: ['KeyA'],
    right: ['KeyD'],
    'sideways-left': [],
    'sideways-right': [],
    slower: ['Digit1'],
    faster: ['Digit2'],
    release: ['KeyR'],
    talk: ['KeyQ'],
    'latency-test': ['Digit5'],
    recentre: ['KeyC'],
    view: ['KeyV'],
    'from-above': ['KeyT'],
    hazards: ['KeyG'],
    enlarge: ['KeyE'],
    dashboard: ['KeyB'],
    swap: ['KeyF'],
    predict: ['Digit4'],
    bookmark: ['Digit6'],
    events: [],
    picture: [],
    clip: [],
    'next-robot': ['Digit3'],
    point: ['Backquote'],
    help: ['KeyZ'],
  },
  right: {
    estop: ['KeyN', 'NumpadDecimal', USUAL_STOP_KEY],
    grip: ['Space', 'ShiftRight', 'Numpad0'],
    forward: ['KeyI', 'Numpad8'],
    back: ['KeyK', 'Numpad5'],
    left: ['KeyJ', 'Numpad4'],
    right: ['KeyL', 'Numpad6'],
    'sideways-left': ['ArrowLeft'],
    'sideways-right': ['ArrowRight'],
    slower: ['Comma', 'NumpadSubtract'],
    faster: ['Period', 'NumpadAdd'],
    release: ['KeyP', 'NumpadMultiply'],
    talk: ['KeyM', 'NumpadDivide'],
    'latency-test': ['Digit8'],
    recentre: ['KeyU', 'Numpad1'],
    view: ['KeyO', 'Numpad2'],
    'from-above': ['KeyY', 'Numpad3'],
    hazards: ['KeyH', 'Numpad7'],
    enlarge: ['Digit9', 'Numpad9'],
    dashboard: ['Digit0'],
    swap: ['Digit7'],
    predict: ['Minus'],
    bookmark: ['BracketLeft'],
    events: ['Semicolon'],
    picture: ['Quote'],
    clip: ['BracketRight'],
    'next-robot': ['Digit6'],
    point: ['Equal'],
    help: ['Slash'],
  },
} as const satisfies Record<string, KeyMap>;
export type KeyPreset = keyof typeof KEY_PRESETS;

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
  | { readonly reason: 'last-stop' }
  | { readonly reason: 'taken'; readonly by: KeyRole }
  | { readonly reason: 'always-stops' }
  | { readonly reason: 'reserved' }
  | { readonly reason: 'full' };

export type KeyChange = { readonly keys: KeyMap } | KeyRefusal;

export function roleOf(keys: KeyMap, code: string): KeyRole | undefined {
  return KEY_ROLES.find((role) => keys[role].includes(code));
}

/** Keys with these roles are held or pressed while the robot moves: typed as a question mark, they still do what they do. */
const DRIVING_ROLES: readonly KeyRole[] = [
  'estop',
  'grip',
  'forward',
  'back',
  'left',
  'right',
  'sideways-left',
  'sideways-right',
  'release',
  'talk',
];

/**
 * The role of a key that was pressed. A question mark asks for help wherever the keyboard has it, unless its key drives or stops.
 *
 * @param typed KeyboardEvent.key
 */
export function pressedRole(keys: KeyMap, code: string, typed: string): KeyRole | undefined {
  const role = roleOf(keys, code);
  if (typed !== '?' || (role !== undefined && DRIVING_ROLES.includes(role))) return role;
  return 'help';
}

/** The one key that a role is known by: the usual one if it still has the role, or else one that was chosen in its place. */
export function mainKey(keys: KeyMap, role: KeyRole): string | undefined {
  const [usual = ''] = DEFAULT_KEYS[role];
  const codes = keys[role];
  return codes.includes(usual)
    ? usual
    : (codes.find((code) => !DEFAULT_KEYS[role].includes(code)) ?? codes[0]);
}

/** Gives a key a role. */
export function assignKey(keys: KeyMap, role: KeyRole, code: string): KeyChange {
  const by = roleOf(keys, code);
  if (by === role) return { keys };
  if (code === STOP_KEY_ALWAYS) return { reason: 'always-stops' };
  if (!isFreeKey(code)) return { reason: 'reserved' };
  if (by !== undefined) return { reason: 'taken', by };
  if (keys[role].length >= MOST_KEYS) return { reason: 'full' };
  return { keys: { ...keys, [role]: [...keys[role], code] } };
}

/** Takes a role from a key. The last key that stops, besides {@link STOP_KEY_ALWAYS}, keeps its role. */
export function removeKey(keys: KeyMap, role: KeyRole, code: string): KeyChange {
  const rest = keys[role].filter((other) => other !== code);
  if (role === 'estop' && rest.length === 0) return { reason: 'last-stop' };
  return { keys: { ...keys, [role]: rest } };
}

/**
 * The usable part of what was stored. Of two roles for a key the first counts; roles that are missing have their usual
 * keys, as far as those are free. STOP has a key in any case.
 */
export function usableKeys(
  stored: Readonly<Partial<Record<KeyRole, readonly string[] | undefined>>>,
): KeyMap {
  let keys = emptyKeys;
  const give = (role: KeyRole, codes: readonly string[] | undefined) => {
    for (const code of codes ?? []) {
      const change = assignKey(keys, role, code);
      if ('keys' in change) keys = change.keys;
    }
  };
  give('estop', stored.estop);
  if (keys.estop.length === 0) give('estop', DEFAULT_KEYS.estop);
  for (const role of KEY_ROLES) give(role, stored[role]);
  for (const role of KEY_ROLES) if (stored[role] === undefined) give(role, DEFAULT_KEYS[role]);
  return keys;
}

const emptyKeys = Object.fromEntries(KEY_ROLES.map((role) => [role, []])) as unknown as KeyMap;
