/**
 * Dialogs that leave the emergency stop in reach. A modal dialog would make it inert and lie over it; these make everything
 * else inert instead.
 */
import { elements } from './elements.ts';

/** In the order in which they were opened. */
const opened: HTMLDialogElement[] = [];
/** What had the focus before. */
const openers = new WeakMap<HTMLDialogElement, Element | null>();

/** Whether the operator is at a dialog, and drives nothing meanwhile. */
export function isDialogOpen(): boolean {
  return topDialog() !== undefined;
}

/** The one that was opened last. A closed dialog tells of it only in a later task; keys may come before. */
function topDialog(): HTMLDialogElement | undefined {
  return opened.findLast(({ open }) => open);
}

/** Opens the dialog, with an empty return value. Escape closes it, and what had the focus before has it again. */
export function openDialog(dialog: HTMLDialogElement): void {
  if (dialog.open) return;
  dialog.returnValue = '';
  opened.push(dialog);
  openers.set(dialog, document.activeElement);
  dialog.addEventListener('close', () => onClosed(dialog), { once: true });
  dialog.show();
  setBehind();
}

function onClosed(dialog: HTMLDialogElement): void {
  opened.splice(opened.indexOf(dialog), 1);
  setBehind();
  const { activeElement } = document;
  const opener = openers.get(dialog);
  // Another dialog may have taken its place. Whoever clicked has no place to return to.
  const isLeft = activeElement === null || activeElement === document.body || dialog.contains(activeElement);
  if (isLeft && opener instanceof HTMLElement && opener !== document.body) opener.focus();
}

/** Whatever is behind the dialog that was opened last takes neither focus nor clicks. */
function setBehind(): void {
  const { stage, bar, robots, hud, side, dashboard, drive, obstacle } = elements;
  const top = topDialog();
  for (const behind of [stage, bar, robots, hud, side, dashboard, drive, obstacle])
    behind.inert = top !== undefined;
  for (const dialog of opened) dialog.inert = dialog !== top;
}

window.addEventListener('keydown', (event) => {
  const top = topDialog();
  // A list that is open takes Escape first.
  if (event.code !== 'Escape' || top === undefined || event.defaultPrevented) return;
  event.preventDefault();
  top.close();
});
