/** Buttons, lists and sliders that give the focus back, so that the space bar stays the drive grip. */

export function quietButton(text: string, title: string, act: () => void): HTMLButtonElement {
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'quiet';
  button.textContent = text;
  button.title = title;
  button.addEventListener('click', () => {
    button.blur();
    act();
  });
  return button;
}

export interface Choice<Value extends string> {
  readonly label: string;
  readonly values: readonly Value[];
  /** What is shown of each. */
  readonly texts: Readonly<Record<Value, string>>;
}

export function selectOf<Value extends string>(
  { label, values, texts }: Choice<Value>,
  choose: (value: Value) => void,
): HTMLSelectElement {
  const select = document.createElement('select');
  select.ariaLabel = label;
  select.append(...values.map((value) => new Option(texts[value], value)));
  select.addEventListener('change', () => {
    select.blur();
    const chosen = values[select.selectedIndex];
    if (chosen !== undefined) choose(chosen);
  });
  return select;
}

export interface SliderScale {
  readonly min: number;
  readonly max: number;
  readonly step: number;
}

export function sliderOf(
  label: string,
  { min, max, step }: SliderScale,
  slide: (value: number) => void,
): HTMLInputElement {
  const slider = document.createElement('input');
  slider.type = 'range';
  slider.ariaLabel = label;
  Object.assign(slider, { min: String(min), max: String(max), step: String(step) });
  slider.addEventListener('input', () => slide(slider.valueAsNumber));
  // Arrow keys still move a slider that was reached by the keyboard.
  slider.addEventListener('pointerup', () => slider.blur());
  return slider;
}

/** A line of a panel: text at the left, a control beside it. */
export function rowOf(text: string, ...controls: readonly HTMLElement[]): HTMLElement {
  const row = document.createElement('div');
  row.className = 'row';
  const name = document.createElement('span');
  name.textContent = text;
  row.append(name, ...controls);
  return row;
}
