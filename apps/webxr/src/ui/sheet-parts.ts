/** Parts of dialogs that are made when they are first opened. */

/** A dialog with a title, in the document, closed. */
export function sheetOf(id: string, title: string): HTMLDialogElement {
  const dialog = document.createElement('dialog');
  dialog.id = id;
  dialog.className = 'sheet';
  // Whoever clicks on its text stays in it.
  dialog.tabIndex = -1;
  const heading = textOf('h2', title);
  heading.id = `${id}-title`;
  dialog.setAttribute('aria-labelledby', heading.id);
  dialog.append(heading);
  document.body.append(dialog);
  return dialog;
}

export function textOf<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  text: string,
  className = '',
): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  element.textContent = text;
  element.className = className;
  return element;
}

export function menuOf(...buttons: readonly HTMLElement[]): HTMLElement {
  const menu = document.createElement('div');
  menu.className = 'menu';
  menu.append(...buttons);
  return menu;
}
