/** Which elements take the letters that are typed: in all others, letters are keys for driving and STOP. */

/** Inputs that take no text. */
const WITHOUT_TEXT: ReadonlySet<string> = new Set([
  'range',
  'checkbox',
  'radio',
  'button',
  'submit',
  'reset',
]);

/** Whether a letter that is typed there is text. */
export function takesText(target: EventTarget | null): boolean {
  // A field whose dialog has just been closed keeps the focus until the next display frame.
  if (!(target instanceof HTMLElement) || !target.checkVisibility()) return false;
  if (target instanceof HTMLTextAreaElement) return true;
  return target instanceof HTMLInputElement && !WITHOUT_TEXT.has(target.type);
}
