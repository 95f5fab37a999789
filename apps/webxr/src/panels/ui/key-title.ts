/** Titles that end with the key that does the same as the button. */
import type { KeyRole } from '../../take/drive/key-map.ts';
import { inputSettings } from '../../take/drive/stored-inputs.ts';
import { withKey } from '../../words/input-words.ts';

const followed = new WeakSet<HTMLElement>();

/**
 * Ends the element's title with the key that has this role now. It is brought up to date whenever somebody is about to read it: the
 * key may have become another one, and the title as well.
 */
export function followKey(element: HTMLElement, role: KeyRole): void {
  const write = () => {
    const title = withKey(element.title, inputSettings.keys.value, role);
    if (element.title !== title) element.title = title;
  };
  write();
  if (followed.has(element)) return;
  followed.add(element);
  for (const type of ['pointerenter', 'focus'] as const) element.addEventListener(type, write);
}
