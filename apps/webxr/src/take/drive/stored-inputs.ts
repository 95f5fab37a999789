/** What this browser keeps about keys, devices and speed. */
import { choicesText, DEFAULT_CHOICES, type InputChoices, parseChoices } from './input-choices.ts';
import { InputSettings } from './input-settings.ts';

const KEY = 'farpoint.inputs';

/** The page's one copy: hands, hints and words follow it. */
export const inputSettings = new InputSettings(load(), store);

function load(): InputChoices {
  try {
    return parseChoices(localStorage.getItem(KEY));
  } catch {
    return DEFAULT_CHOICES;
  }
}

function store(choices: InputChoices): void {
  try {
    localStorage.setItem(KEY, choicesText(choices));
  } catch {
    // Private browsing: what is chosen lasts for this visit only.
  }
}
