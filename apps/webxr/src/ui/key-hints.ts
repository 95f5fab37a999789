/** The keys that the page names follow what the operator has chosen. The page's text names the usual ones. */
import { effect, type ReadonlySignal } from '@preact/signals-core';
import { DEFAULT_KEYS, type KeyMap, type KeyRole, roleOf } from '../drive/key-map.ts';
import { keyName } from '../status/input-words.ts';

/** The role of each `<kbd>` and the usual key that its text names. */
const places = new WeakMap<Element, { role: KeyRole; usual: string } | null>();

/** Writes the keys of `keys` into every `<kbd>` within `within`. */
export function followKeys(within: ParentNode, keys: KeyMap): void {
  for (const key of within.querySelectorAll('kbd')) {
    let named = places.get(key);
    if (named === undefined) {
      named = usualPlace(key.textContent ?? '');
      places.set(key, named);
    }
    if (named === null) continue;
    const code = namedKey(keys[named.role], named);
    key.textContent = code === undefined ? '–' : keyName(code);
  }
}

/** Titles that have been written, and those that the page gave, with the usual key in brackets at the end. */
const titles = new WeakMap<HTMLElement, { given: string; written: string }>();
const KEY_AT_END = / \((\S+)\)$/;

/** Writes the keys of `keys` into every title within `within` that ends with a key in brackets. */
export function followKeyTitles(within: ParentNode, keys: KeyMap): void {
  for (const element of within.querySelectorAll<HTMLElement>('[title]')) {
    const before = titles.get(element);
    const given = before?.written === element.title ? before.given : element.title;
    const named = usualPlace(KEY_AT_END.exec(given)?.[1] ?? '');
    if (named === null) continue;
    const code = namedKey(keys[named.role], named);
    const written = given.replace(KEY_AT_END, code === undefined ? '' : ` (${keyName(code)})`);
    titles.set(element, { given, written });
    if (element.title !== written) element.title = written;
  }
}

/** Keeps the titles within `within` so, whatever is put there and whichever keys are chosen. */
export function keepKeyTitles(within: HTMLElement, keys: ReadonlySignal<KeyMap>): void {
  const write = () => followKeyTitles(within, keys.peek());
  effect(() => followKeyTitles(within, keys.value));
  new MutationObserver(write).observe(within, {
    ...{ subtree: true, childList: true, attributeFilter: ['title'] },
  });
}

/** The usual key if it has the role still, or else one that was chosen in its place. */
function namedKey(
  codes: readonly string[],
  { role, usual }: { role: KeyRole; usual: string },
): string | undefined {
  if (codes.includes(usual)) return usual;
  return codes.find((code) => !DEFAULT_KEYS[role].includes(code)) ?? codes[0];
}

function usualPlace(name: string): { role: KeyRole; usual: string } | null {
  const usual = Object.values(DEFAULT_KEYS)
    .flat()
    .find((code) => keyName(code) === name);
  const role = usual === undefined ? undefined : roleOf(DEFAULT_KEYS, usual);
  return usual === undefined || role === undefined ? null : { role, usual };
}
