/** Parts of a dialog whose contents change under the operator's hands. The keyboard's focus stays where it was. */

/** @param label what is heard, if the text alone does not say it */
export function dialogButton(text: string, label: string, act: () => void): HTMLButtonElement {
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'quiet';
  button.textContent = text;
  button.ariaLabel = label;
  button.addEventListener('click', act);
  return button;
}

export function checkOf(
  text: string,
  label: string,
  choose: (checked: boolean) => void,
): [HTMLElement, HTMLInputElement] {
  const element = document.createElement('label');
  element.className = 'check';
  const box = document.createElement('input');
  box.type = 'checkbox';
  box.ariaLabel = label;
  box.addEventListener('change', () => choose(box.checked));
  element.append(box, text);
  return [element, box];
}

export function headingOf(text: string, level: 'h2' | 'h3' = 'h3'): HTMLHeadingElement {
  const heading = document.createElement(level);
  heading.textContent = text;
  return heading;
}

export function paragraphOf(text: string, className = ''): HTMLParagraphElement {
  const paragraph = document.createElement('p');
  paragraph.textContent = text;
  paragraph.className = className;
  return paragraph;
}

/** Renders anew. What had the focus within `element` keeps it, or else what now stands last in its row. */
export function keepingFocus(element: HTMLElement, render: () => void): void {
  const { activeElement } = document;
  if (!(activeElement instanceof HTMLElement) || !element.contains(activeElement)) {
    render();
    return;
  }
  const label = activeElement.ariaLabel;
  const row = [...element.children].findIndex((child) => child.contains(activeElement));
  render();
  const controls = [...element.querySelectorAll<HTMLElement>('button, input')];
  const same = controls.find(({ ariaLabel }) => ariaLabel === label);
  const last = element.children[row]?.querySelector<HTMLElement>('button:last-of-type');
  (same ?? last)?.focus();
}
