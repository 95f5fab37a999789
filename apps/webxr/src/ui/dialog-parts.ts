/** Parts of dialogs whose contents change under the operator's hands. */

export function dialogButton(text: string, label: string, act: () => void): HTMLButtonElement {
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'quiet';
  button.textContent = text;
  button.ariaLabel = label;
  button.addEventListener('click', act);
  return button;
}

export function checkOf(text: string, choose: (checked: boolean) => void): [HTMLElement, HTMLInputElement] {
  const label = document.createElement('label');
  label.className = 'check';
  const box = document.createElement('input');
  box.type = 'checkbox';
  box.addEventListener('change', () => choose(box.checked));
  label.append(box, text);
  return [label, box];
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
